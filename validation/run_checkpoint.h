// What the harness itself must remember of a run, beside the solver's state, to go on with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "validation/case.h"
#include "validation/run_manifest.h"
#include "validation/run_settings.h"
#include "validation/series.h"

namespace sluice {

struct RunPoint {
  RunTally tally;
  ProbeWriter::Position probes;
  std::int64_t next_sample = 0;
  std::size_t next_snapshot = 0;
  std::size_t snapshots = 0;                          ///< written so far
  std::int64_t resumed = 0;                           ///< times
  std::string started;                                ///< when, as in run.json
  nlohmann::json legs = nlohmann::json::array();      ///< as in run.json, up to here
  nlohmann::json warnings = nlohmann::json::array();  ///< likewise
};

/// A checkpoint's header.
struct RunHeader {
  RunSettings settings;
  std::string case_file;  ///< where the case was read from
  std::string case_hash;
  std::string computed_hash;  ///< empty in checkpoints that do not tell it yet
  std::string commit;         ///< of the program that wrote it
  RunPoint point;
};

nlohmann::json to_json(const RunHeader& header);
/// Throws nlohmann::json::exception when something is missing.
RunHeader run_header_from(const nlohmann::json& json);

}  // namespace sluice
