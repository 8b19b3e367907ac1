// What a campaign's runs are on disk, and what is left to compute of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "validation/campaign.h"
#include "validation/checkpoint.h"
#include "validation/run_checkpoint.h"
#include "validation/run_lock.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Null where there is none, or where it cannot be read.
json manifest_of(const fs::path& directory) {
  std::ifstream in(directory / "run.json");
  if (!in) return {};
  json manifest = json::parse(in, nullptr, false);
  if (!manifest.is_object()) manifest = nullptr;
  return manifest;
}

/// What a run leaves, with or without a manifest that can be read.
bool holds_results(const fs::path& directory) {
  return fs::exists(directory / "run.json") || fs::exists(directory / checkpoint_file) ||
         fs::exists(directory / "probes.csv");
}

std::string text_of(const json& manifest, const char* key) {
  return manifest.contains(key) && manifest[key].is_string() ? manifest[key].get<std::string>() : "";
}

/// Keys of a manifest that are not as the run is asked for.
std::vector<std::string> other_inputs(const json& manifest, const Case& c, const RunSettings& s) {
  const std::vector<std::pair<const char*, json>> inputs{{"solver", s.solver},
                                                         {"walls", s.walls},
                                                         {"l0_m", s.l0_m},
                                                         {"t_end_s", s.t_end_s},
                                                         {"output_rate_Hz", s.output_rate_Hz},
                                                         {"parameters", s.parameters}};
  std::vector<std::string> others;
  const std::string computed = text_of(manifest, "computed_hash");
  if (!has_inputs_of(c, computed, text_of(manifest, "case_hash")))
    others.emplace_back(computed.empty() ? "case_hash" : "computed_hash");
  for (const auto& [key, value] : inputs)
    if (!manifest.contains(key) || manifest[key] != value) others.emplace_back(key);
  return others;
}

/// Where a run goes on; its manifest may be of later. Zero where the checkpoint cannot be read: the run will tell.
double checkpoint_time_s(const fs::path& directory) {
  try {
    return run_header_from(read_checkpoint_header(directory / checkpoint_file)).point.probes.last_t_s;
  } catch (const std::exception&) {
    return 0;
  }
}

/// Whether snapshots are asked for that the run was not told to write. Manifests that do not say it yet: whether a
/// finished run has none.
bool lacks_snapshots(const json& manifest, const CampaignRun& run) {
  if (run.settings.snapshot_times_s.empty()) return false;
  if (manifest.contains("snapshot_times_s")) return manifest["snapshot_times_s"] != run.settings.snapshot_times_s;
  return text_of(manifest, "status") == "finished" && !fs::exists(run.directory / "snapshots.pvd");
}

/// What is not as asked for; empty for a run of today's inputs.
std::string outdated_by(const json& manifest, const Case& c, const CampaignRun& run) {
  const auto others = other_inputs(manifest, c, run.settings);
  if (!others.empty()) return fmt::format("not as in its run.json: {}", fmt::join(others, ", "));
  return lacks_snapshots(manifest, run) ? "without the snapshots asked for" : "";
}

}  // namespace

CampaignState state_of(const Campaign& campaign, const CampaignRun& run) {
  const json manifest = manifest_of(run.directory);
  if (manifest.is_null()) return holds_results(run.directory) ? CampaignState::outdated : CampaignState::absent;
  if (!outdated_by(manifest, campaign.case_of(run), run).empty()) return CampaignState::outdated;
  if (text_of(manifest, "status") == "finished") return CampaignState::finished;
  return fs::exists(run.directory / checkpoint_file) ? CampaignState::resumable : CampaignState::incomplete;
}

bool can_be_reported(const Campaign& campaign, const CampaignRun& run) {
  const json manifest = manifest_of(run.directory);
  return !manifest.is_null() && text_of(manifest, "status") == "finished" &&
         other_inputs(manifest, campaign.case_of(run), run.settings).empty();
}

std::string why_outdated(const Campaign& campaign, const CampaignRun& run) {
  const json manifest = manifest_of(run.directory);
  if (manifest.is_null()) return holds_results(run.directory) ? "its run.json cannot be read" : "";
  return outdated_by(manifest, campaign.case_of(run), run);
}

fs::path set_aside(const fs::path& run) {
  const fs::path folder = run.parent_path() / "outdated";
  fs::path place = folder / run.filename();
  try {
    for (int k = 2; fs::exists(place); ++k) place = folder / fmt::format("{}-{}", run.filename().string(), k);
    const RunLock lock(run);
    if (!lock.held() && text_of(manifest_of(run), "status") == "running")
      throw std::runtime_error(
          fmt::format("{}: a run may be going on here, and the file system knows no locks (where it was killed, move "
                      "the folder away)",
                      run.string()));
    fs::create_directories(folder);
    fs::rename(run, place);
  } catch (const fs::filesystem_error& error) {
    throw std::runtime_error(
        fmt::format("{}: cannot be moved to {}, to make way for a new run: {} (move it away, or remove it)",
                    run.string(), place.string(), error.code().message()));
  }
  return place;
}

std::string to_string(CampaignState state) {
  switch (state) {
    case CampaignState::absent:
      return "to do";
    case CampaignState::finished:
      return "finished";
    case CampaignState::resumable:
      return "to resume";
    case CampaignState::incomplete:
      return "to repeat";
    case CampaignState::outdated:
      return "outdated";
  }
  return "";
}

CampaignEstimate estimate(const Campaign& campaign, const CampaignRun& run, const std::vector<RunCost>& costs,
                          bool anew) {
  CampaignEstimate e;
  const Case& c = campaign.case_of(run);
  e.plan = plan_run(c, run.settings);
  reckon_by(costs, c, run.settings, e.plan);
  if (!anew && state_of(campaign, run) == CampaignState::resumable)
    e.done_share = std::clamp(checkpoint_time_s(run.directory) / run.settings.t_end_s, 0.0, 1.0);
  return e;
}

std::vector<RunCost> known_costs(const Campaign& campaign, const std::vector<fs::path>& others) {
  std::vector<fs::path> directories;
  for (const CampaignRun& run : campaign.runs) directories.push_back(run.directory);
  directories.insert(directories.end(), others.begin(), others.end());
  return run_costs(directories);
}

}  // namespace sluice
