#include "validation/run_directory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace sluice {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string complaint(const std::string& manifest) {
  try {
    parse_run(manifest, "runs/x");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(RunDirectory, ThreeLinesSuffice) {
  const RunRecord run = parse_run(R"({"case": "kleefsman", "solver": "interFoam", "l0_m": 0.02})", "runs/x");
  EXPECT_EQ(run.case_name, "kleefsman");
  EXPECT_EQ(run.l0_m, 0.02);
  EXPECT_FALSE(run.own);
  EXPECT_EQ(run.label(), "interFoam, l0 = 0.02 m");
  EXPECT_FALSE(run.number("particles.fluid").has_value());
}

TEST(RunDirectory, AnEmptyManifestIsNotAMissingOne) {
  const std::filesystem::path directory = std::filesystem::temp_directory_path() / "sluice-empty-manifest";
  std::filesystem::create_directories(directory);
  std::ofstream(directory / "run.json").flush();
  try {
    read_run(directory);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("run.json: is empty"), HasSubstr("\"case\"")));
  }
  std::filesystem::remove_all(directory);
}

TEST(RunDirectory, WarningsAreTheTextsAmongThem) {
  const auto warnings = [](const std::string& value) {
    return parse_run(R"({"case": "c", "solver": "s", "l0_m": 0.02, "warnings": )" + value + "}", "runs/x").warnings();
  };
  EXPECT_THAT(warnings(R"(["one", 2, {"a": "b"}, "three"])"), ElementsAre("one", "three"));
  EXPECT_THAT(warnings(R"("one")"), IsEmpty());
  EXPECT_THAT(parse_run(R"({"case": "c", "solver": "s", "l0_m": 0.02})", "runs/x").warnings(), IsEmpty());
}

TEST(RunDirectory, ManifestsThatCannotBeUsedAreRefused) {
  EXPECT_THAT(complaint(""), StartsWith("runs/x/run.json: is not valid JSON: parse error at line 1, column 1"));
  EXPECT_THAT(complaint("[1]"), StartsWith("runs/x/run.json: is not a JSON object"));
  EXPECT_THAT(complaint(R"({"case": "c", "solver": "s", "l0_m": 1e999})"),
              StartsWith("runs/x/run.json: is not valid JSON: number overflow"));
  EXPECT_THAT(complaint(R"({"case": "c", "solver": "s"})"),
              AllOf(StartsWith("runs/x/run.json: l0_m: is missing"), HasSubstr("\"l0_m\": 0.02")));
  EXPECT_THAT(complaint(R"({"case": "c", "solver": 3, "l0_m": 0.02})"), StartsWith("runs/x/run.json: solver: "));
  EXPECT_THAT(complaint(R"({"case": "c", "solver": "s", "l0_m": -0.02})"), StartsWith("runs/x/run.json: l0_m: "));
  EXPECT_THAT(complaint("{\"a\": \x7f}"), HasSubstr("\\x7f"));
}

TEST(RunDirectory, DeepNestingIsRefused) {
  EXPECT_THAT(complaint(std::string(1'000'000, '[')),
              StartsWith("runs/x/run.json: is nested deeper than 100 levels ("));
}

TEST(RunDirectory, ARefusedManifestIsToldWhatSuffices) {
  const std::string remedy = R"( (correct it, or write { "case": "kleefsman", "solver": "name", "l0_m": 0.02 }))";
  for (const std::string& text : {std::string("{\"case\": "), std::string("[1]"), std::string(200, '[')})
    EXPECT_THAT(complaint(text), EndsWith(remedy));
  const std::string suffices = remedy.substr(remedy.find('{'), remedy.find('}') + 1 - remedy.find('{'));
  EXPECT_EQ(complaint(suffices), "no complaint");
}

}  // namespace
}  // namespace sluice
