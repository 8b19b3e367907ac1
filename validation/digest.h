// Turns raw measured files, which stay outside the project, into the compact digest that the project keeps.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

/// One column of the raw files that goes into the digest.
struct DigestColumn {
  int number = 0;        ///< in the raw file, from 1
  std::string raw_name;  ///< what the raw file calls it
  std::string name;      ///< what the project calls it (the two differ where the raw header is wrong)
  std::string unit;      ///< after scaling
  double scale = 1;      ///< raw value times this is in `unit`
  int mean_decimals = 3;
  int extreme_decimals = 3;
};

/// One raw file and how its rows are written.
struct RawFile {
  std::filesystem::path file;  ///< relative to the folder of raw data
  std::string hash;            ///< as file_hash() gives it; empty: not checked
  int header_lines = 0;
  std::string header;    ///< the last header line, word for word; empty: not checked
  char separator = ' ';  ///< blank stands for any run of blanks and tabs
};

/// What is known of the raw files of one digest.
struct DigestSource {
  std::vector<RawFile> files;  ///< several only of a scatter: their points are put together
  int column_count = 0;
  int time_column = 1;
  double time_scale = 1;  ///< raw time times this is in seconds
  /// The rows are points of a cloud, in any order, such as those clicked on a printed figure; otherwise samples of one
  /// recording, whose times increase.
  bool scatter = false;
  double bin_s = 0;
  double smoothing_s = 0;  ///< width of the running mean whose maxima are kept; 0: none kept
  std::vector<DigestColumn> columns;
};

/// Throws std::runtime_error "file:line: key: what is wrong; remedy".
DigestSource load_digest_source(const std::filesystem::path& toml_path);
/// The same from text; `toml_path` is what messages call it.
DigestSource parse_digest_source(std::string_view text, const std::filesystem::path& toml_path);

/// One digest of a data folder: source.toml makes digest.csv, NAME.source.toml makes NAME.csv.
struct DigestPlan {
  std::filesystem::path description;
  std::filesystem::path digest;
};
/// All of a folder, by name. Throws std::runtime_error when it holds no description.
std::vector<DigestPlan> digest_plans(const std::filesystem::path& data_folder);

/// The folder of raw data: the environment variable SLUICE_RAW_DATA or, without it, ../shared/data.
std::filesystem::path raw_data_folder();

/// Where its raw files lie below a folder of raw data.
std::vector<std::filesystem::path> raw_paths(const DigestSource& source, const std::filesystem::path& raw_root);

/// Reads the raw files and writes the digest: `t_s` (bin centres) and the mean, minimum and maximum of each column in
/// bins of equal width that start at t = 0. `raw` are as many as source.files.
///
/// Of a recording the mean is the integral of the samples' linear interpolant over the bin, divided by its width, so
/// that impulses over whole bins survive; a first or last bin that the samples cover by less than nine tenths is left
/// out. Of a scatter it is the mean of the bin's points, each counting alike; their number is kept as
/// `<name>_points_1`, a bin without points gets the straight line between its neighbours, and half a cover suffices at
/// the ends. Running means are those of the interpolant, through the mean of points at equal times.
///
/// Throws std::runtime_error naming file and line when a raw file is not what the description says.
void make_digest(const DigestSource& source, const std::vector<std::filesystem::path>& raw,
                 const std::filesystem::path& out_csv);
/// The digest of the raw files' texts, which messages call as source.files does.
std::string digest_of(const DigestSource& source, std::span<const std::string_view> raw_texts);

/// All digests of a data folder from the raw files under `raw_root`. Returns the paths written.
std::vector<std::filesystem::path> make_digests(const std::filesystem::path& data_folder,
                                                const std::filesystem::path& raw_root);

}  // namespace sluice
