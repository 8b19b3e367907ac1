#include <fmt/format.h>

#include <memory>
#include <string>

#include "validation/case.h"
#include "validation/cli/commands.h"
#include "validation/digest.h"

namespace sluice::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string folder = "data/kleefsman2005";
  std::string raw;
  std::string out;
};

int digest(const Arguments& arguments) {
  const fs::path folder = resolve_in_source_tree(arguments.folder);
  const DigestSource source = load_digest_source(folder / "source.toml");
  const fs::path raw = arguments.raw.empty() ? raw_data_folder() / source.raw_file : fs::path(arguments.raw);
  const fs::path out = arguments.out.empty() ? folder / "digest.csv" : fs::path(arguments.out);
  make_digest(source, raw, out);
  fmt::print("{} from {}\n", out.string(), raw.string());
  return 0;
}

}  // namespace

void add_data(CLI::App& app, int& exit_code) {
  CLI::App* data = app.add_subcommand("data", "Measured data");
  data->require_subcommand(1);
  data->footer("Example:\n  sluice data digest --help");
  CLI::App* command = data->add_subcommand("digest", "Make the digest of a measured series from its raw file");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("FOLDER", arguments->folder, "Data folder with source.toml")->capture_default_str();
  command->add_option("--raw", arguments->raw,
                      "Raw file (default: as source.toml names it, below $SLUICE_RAW_DATA or ../shared/data)");
  command->add_option("--out", arguments->out, "Digest (default: FOLDER/digest.csv)");
  command->footer(
      "Examples:\n"
      "  sluice data digest\n"
      "  sluice data digest data/kleefsman2005 --raw ~/Downloads/test_case_2_exp_data.dat --out digest.csv");
  command->callback([arguments, &exit_code] { exit_code = digest(*arguments); });
}

}  // namespace sluice::cli
