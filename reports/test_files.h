// Files of the report's tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace sluice::test_files {

inline std::string read(const std::filesystem::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// A path below the tests' folder at which nothing is. Absolute: a test may change the working directory.
inline std::filesystem::path fresh(const std::string& name) {
  std::filesystem::path path =
      std::filesystem::absolute(std::filesystem::path(testing::TempDir()) / ("sluice_report_" + name));
  std::filesystem::remove_all(path);
  return path;
}

/// Puts entries into a run's manifest (as a JSON merge patch: objects are merged).
inline void put_in_manifest(const std::filesystem::path& run, const nlohmann::json& entries) {
  nlohmann::json manifest = nlohmann::json::parse(read(run / "run.json"));
  manifest.merge_patch(entries);
  std::ofstream(run / "run.json") << manifest;
}

}  // namespace sluice::test_files
