// Turns a raw measured file, which stays outside the project, into the compact digest that the project keeps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sluice {

/// One column of the raw file that goes into the digest.
struct DigestColumn {
  int number = 0;        ///< in the raw file, from 1
  std::string raw_name;  ///< what the raw file calls it
  std::string name;      ///< what the project calls it (the two differ where the raw header is wrong)
  std::string unit;      ///< after scaling
  double scale = 1;      ///< raw value times this is in `unit`
  int mean_decimals = 3;
  int extreme_decimals = 3;
};

/// What is known of a raw file: data/<case>/source.toml.
struct DigestSource {
  std::filesystem::path raw_file;  ///< relative to the folder of raw data
  std::string raw_hash;            ///< as file_hash() gives it; empty: not checked
  int header_lines = 0;
  std::string header;    ///< the last header line, word for word; empty: not checked
  char separator = ' ';  ///< blank stands for any run of blanks and tabs
  int column_count = 0;
  int time_column = 1;
  double time_scale = 1;  ///< raw time times this is in seconds
  double bin_s = 0;
  double smoothing_s = 0;  ///< width of the running mean whose maxima are kept; 0: none kept
  std::vector<DigestColumn> columns;
};

/// Throws std::runtime_error "file:line: key: what is wrong; remedy".
DigestSource load_digest_source(const std::filesystem::path& toml_path);

/// The folder of raw data: the environment variable SLUICE_RAW_DATA or, without it, ../shared/data.
std::filesystem::path raw_data_folder();

/// Reads the raw file and writes the digest: `t_s` (bin centres) and the mean, minimum and maximum of each column in
/// bins of equal width that start at t = 0. The mean is the integral of the samples' linear interpolant over the bin,
/// divided by its width, so that impulses over whole bins survive; a first or last bin that the samples cover by less
/// than nine tenths is left out. Throws std::runtime_error naming file and line when the raw file is not what the
/// description says.
void make_digest(const DigestSource& source, const std::filesystem::path& raw_path,
                 const std::filesystem::path& out_csv);

/// The same from a data folder: reads <folder>/source.toml, finds the raw file under `raw_root`, writes
/// <folder>/digest.csv. Returns the path written.
std::filesystem::path make_digest(const std::filesystem::path& data_folder, const std::filesystem::path& raw_root);

}  // namespace sluice
