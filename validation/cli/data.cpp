#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "validation/case.h"
#include "validation/cli/commands.h"
#include "validation/cli/usage_error.h"
#include "validation/digest.h"

namespace sluice::cli {
namespace {

namespace fs = std::filesystem;

struct DataArguments {
  std::string folder = "data/kleefsman2005";
  std::vector<std::string> raw;
  std::string out;
};

int digest(const DataArguments& arguments) {
  const std::vector<DigestPlan> plans = digest_plans(resolve_in_source_tree(arguments.folder));
  if (plans.size() > 1 && !(arguments.raw.empty() && arguments.out.empty()))
    throw UsageError(
        fmt::format("{} makes {} digests, so --raw and --out cannot say which (put the raw files where "
                    "its descriptions expect them, below $SLUICE_RAW_DATA)",
                    arguments.folder, plans.size()));
  for (const DigestPlan& plan : plans) {
    const DigestSource source = load_digest_source(plan.description);
    const std::vector<fs::path> raw = arguments.raw.empty()
                                          ? raw_paths(source, raw_data_folder())
                                          : std::vector<fs::path>(arguments.raw.begin(), arguments.raw.end());
    const fs::path out = arguments.out.empty() ? plan.digest : fs::path(arguments.out);
    make_digest(source, raw, out);
    std::string names;
    for (const fs::path& path : raw) names += (names.empty() ? "" : ", ") + path.string();
    fmt::print("{} from {}\n", out.string(), names);
  }
  return 0;
}

}  // namespace

void add_data(CLI::App& app, int& exit_code) {
  CLI::App* data = app.add_subcommand("data", "Measured data");
  data->require_subcommand(1);
  data->footer("Example:\n  sluice data digest --help");
  CLI::App* command = data->add_subcommand("digest", "Make the digests of a data folder from its raw files");
  auto arguments = std::make_shared<DataArguments>();
  command->add_option("FOLDER", arguments->folder, "Data folder with source.toml (and NAME.source.toml)")
      ->capture_default_str();
  command->add_option(
      "--raw", arguments->raw,
      "Raw file, as many as source.toml names (default: those, below $SLUICE_RAW_DATA or ../shared/data)");
  command->add_option("--out", arguments->out, "Digest (default: FOLDER/digest.csv)");
  command->footer(
      "Examples:\n"
      "  sluice data digest\n"
      "  sluice data digest data/kleefsman2005 --raw ~/Downloads/test_case_2_exp_data.dat --out digest.csv\n"
      "  sluice data digest data/aureli2015 --raw force.csv");
  command->callback([arguments, &exit_code] { exit_code = digest(*arguments); });
}

}  // namespace sluice::cli
