#include "validation/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "validation/toml_reader.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// Far more than anybody computes; a slip of the pen in a list makes more.
constexpr std::size_t most_runs = 10'000;

/// One [[runs]] group as written.
struct Group {
  std::size_t the_case = 0;
  RunRequest request;
  std::vector<std::string> walls;
  std::vector<double> l0_m;
  std::vector<std::optional<double>> alpha;
};

std::size_t case_index(TomlReader& reader, Campaign& campaign, const fs::path& file) {
  const std::string name = reader.text("case");
  const bool is_path = fs::path(name).extension() == ".toml";
  Case c = load_case_for(reader, is_path ? (file.parent_path() / name).string() : name);
  for (std::size_t i = 0; i < campaign.cases.size(); ++i) {
    std::error_code gone;
    if (fs::equivalent(campaign.cases[i].file, c.file, gone)) return i;
    // Runs and reports are named by it.
    if (campaign.cases[i].name == c.name)
      reader.fail("case", fmt::format("{} and {} both call themselves {} (give one another name)",
                                      campaign.cases[i].file.string(), c.file.string(), c.name));
  }
  campaign.cases.push_back(std::move(c));
  return campaign.cases.size() - 1;
}

Group parse_group(TomlReader reader, Campaign& campaign, const fs::path& file, int threads) {
  Group group;
  group.the_case = case_index(reader, campaign, file);
  group.request.threads = threads;
  group.request.solver = reader.text("solver");
  group.walls = reader.has("walls") ? reader.texts("walls") : std::vector<std::string>{""};
  group.l0_m = reader.numbers("l0_m");
  if (reader.has("alpha")) {
    for (const double alpha : reader.numbers("alpha")) group.alpha.emplace_back(alpha);
  } else {
    group.alpha = {std::nullopt};
  }
  if (const auto t_end_s = reader.optional_number("t_end_s")) group.request.overrides.emplace_back("t_end_s", *t_end_s);
  group.request.snapshots = reader.flag_or("snapshots", false);
  if (reader.has("parameters"))
    for (const auto& parameter : reader.table("parameters").all_numbers()) group.request.overrides.push_back(parameter);
  if (group.walls.empty()) reader.fail("walls", "is empty (leave it out for the default)");
  if (group.l0_m.empty()) reader.fail("l0_m", "is empty (give particle distances in metres)");
  if (group.alpha.empty()) reader.fail("alpha", "is empty (leave it out for the default)");
  reader.finish();
  return group;
}

/// kleefsman-wcsph-extrapolated-l0.020-alpha0.01, with what else the group sets.
fs::path directory_of(const Case& c, const RunSettings& settings, const Group& group, const fs::path& out) {
  std::string name = default_run_directory(c, settings).filename().string();
  for (const auto& [key, value] : group.request.overrides)
    if (key != "t_end_s" || value != c.t_end_s) name += fmt::format("-{}{}", key, value);
  return out / name;
}

/// Throws CaseError where the directory is not new, or one too many.
void remember_directory(const TomlReader& reader, const fs::path& directory, std::set<fs::path>& directories) {
  if (!directories.insert(directory).second)
    reader.fail("", fmt::format("{} occurs twice (take it out of one of the lists)", directory.filename().string()));
  if (directories.size() > most_runs)
    reader.fail("", fmt::format("makes more than {} runs (shorten its lists, or make several campaigns)", most_runs));
}

void add_runs(TomlReader& reader, const Group& group, Campaign& campaign, std::set<fs::path>& directories,
              const fs::path& out) {
  const Case& c = campaign.cases[group.the_case];
  for (const std::string& walls : group.walls) {
    for (const double l0_m : group.l0_m) {
      for (const auto& alpha : group.alpha) {
        RunRequest request = group.request;
        request.walls = walls;
        request.l0_m = l0_m;
        if (alpha) request.overrides.emplace_back("alpha", *alpha);
        CampaignRun run;
        run.the_case = group.the_case;
        try {
          run.settings = resolve_settings(c, request);
        } catch (const std::invalid_argument& error) {
          reader.fail("", error.what());
        }
        run.directory = directory_of(c, run.settings, group, out);
        remember_directory(reader, run.directory, directories);
        campaign.runs.push_back(std::move(run));
      }
    }
  }
}

}  // namespace

Campaign load_campaign(const fs::path& file, const fs::path& out, int threads) {
  return parse_campaign(read_text(file, "give the path of a campaign's TOML file"), file, out, threads);
}

Campaign parse_campaign(std::string_view text, const fs::path& file, const fs::path& out, int threads) {
  const toml::table table = parse_toml(text, file.string());
  TomlReader root(table, file.string());
  Campaign campaign;
  campaign.name = root.text("name");
  std::set<fs::path> directories;
  for (TomlReader& reader : root.tables("runs")) {
    const Group group = parse_group(reader, campaign, file, threads);
    add_runs(reader, group, campaign, directories, out);
  }
  if (root.has("slurm")) campaign.slurm = parse_slurm(root.table("slurm"));
  root.finish();
  return campaign;
}

}  // namespace sluice
