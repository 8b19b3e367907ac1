// What a report says of runs that are not to be trusted as they are, and of comparisons of what is not alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/bias.h"
#include "reports/sections.h"
#include "reports/studies.h"
#include "reports/synthetic_run.h"
#include "reports/tables.h"
#include "reports/test_files.h"
#include "reports/test_tables.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using synthetic::MadeForceRun;
using test_files::fresh;
using test_files::put_in_manifest;

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = test_files::read(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  std::ofstream(file) << text.replace(at, from.size(), to);
}

bool any_has(const std::vector<std::string>& texts, const std::string& part) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const std::string& t) { return t.find(part) != std::string::npos; });
}

TEST(Doubts, AColumnThatNoSensorReadsIsNamedWithWhatWasMeant) {
  const fs::path run = fresh("doubts_column");
  synthetic::write_external_run(run, 1);
  EXPECT_FALSE(any_has(analyse({run}).runs[0].problems, "belongs to no sensor"));
  replace_in(run / "probes.csv", "P1_Pa", "P1_kPa");
  EXPECT_TRUE(any_has(analyse({run}).runs[0].problems,
                      "column P1_kPa belongs to no sensor of the case and is not read (did you mean P1_Pa?)"));
}

TEST(Doubts, SeveralModelsOfWhichNoneIsToBeJudgedAreNamed) {
  const fs::path run = fresh("doubts_models");
  synthetic::write_external_run(run, 1);
  replace_in(run / "probes.csv", "P1_Pa", "P1_wall_Pa");
  EXPECT_FALSE(any_has(analyse({run}).runs[0].problems, "none of them the one to be judged")) << "the only one is";
  std::string text = test_files::read(run / "probes.csv");
  std::string doubled;
  for (std::size_t at = 0, row = 0; at < text.size(); ++row) {
    const std::size_t end = text.find('\n', at);
    doubled += text.substr(at, end - at) + (row == 0 ? ",P1_kernel_Pa\n" : ",0\n");
    at = end + 1;
  }
  std::ofstream(run / "probes.csv") << doubled;
  EXPECT_TRUE(any_has(analyse({run}).runs[0].problems, "P1 has columns of 2 models, none of them"));
}

/// Rows of probes.csv that a test of their time keeps.
template <class Keeps>
void keep_rows(const fs::path& run, Keeps keeps) {
  std::istringstream rows(test_files::read(run / "probes.csv"));
  std::string line;
  std::getline(rows, line);
  std::string kept = line + '\n';
  while (std::getline(rows, line))
    if (keeps(std::stod(line))) kept += line + '\n';
  std::ofstream(run / "probes.csv") << kept;
}

TEST(Doubts, ARunWithAGapSaysWhereAndHasNoImpulse) {
  const fs::path run = fresh("doubts_gap");
  synthetic::write_external_run(run, 1);
  keep_rows(run, [](double t_s) { return t_s < 0.4 || t_s > 0.7; });
  const ReportData data = analyse({run});
  EXPECT_TRUE(any_has(data.runs[0].problems, "has no rows between 0.39")) << data.runs[0].problems.front();
  EXPECT_FALSE(data.runs[0].primary("P1")->comparison.impulse.simulated);
}

/// Where the peak was, and nobody would see that it is gone.
TEST(Doubts, RowsThatMissAnImpactAreTold) {
  const fs::path run = fresh("doubts_short_gap");
  synthetic::write_external_run(run, 1);
  EXPECT_FALSE(any_has(analyse({run}).runs[0].problems, "has no row")) << "nothing is missing yet";
  keep_rows(run, [](double t_s) { return t_s < 0.42 || t_s > 0.47; });
  const auto problems = analyse({run}).runs[0].problems;
  EXPECT_TRUE(any_has(problems, "has no row for 5")) << problems.size();
  EXPECT_TRUE(any_has(problems, "ms from 0.41"));
}

TEST(Doubts, RowsThatAreFarApartAreTold) {
  const fs::path run = fresh("doubts_coarse");
  synthetic::write_external_run(run, 1);
  double last_s = -1;
  keep_rows(run, [&](double t_s) {
    if (t_s < last_s + 0.0999) return false;
    last_s = t_s;
    return true;
  });
  EXPECT_TRUE(
      any_has(analyse({run}).runs[0].problems, "has rows more than 10 ms apart over 100 % of its time (up to 100 ms)"));
}

TEST(Doubts, ARunCountsOnce) {
  const fs::path run = fresh("doubts_once");
  synthetic::write_external_run(run, 1);
  EXPECT_EQ(analyse({run, run / ".", run}).runs.size(), 1u) << "given twice";
  const fs::path copy = fresh("doubts_once_more");
  fs::copy(run, copy, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  const ReportData data = analyse({run, copy});
  ASSERT_EQ(data.runs.size(), 2u);
  EXPECT_FALSE(any_has(data.runs[0].problems, "byte for byte"));
  EXPECT_TRUE(any_has(data.runs[1].problems, "its series are those of R1, byte for byte"));
}

TEST(Doubts, SeriesOfOtherCodesHaveTheirHashAndSources) {
  const fs::path run = fresh("doubts_sources");
  synthetic::write_external_run(run, 1);
  put_in_manifest(run, {{"imported_from", {{{"file", "gauges.csv"}, {"hash", "fnv1a64:0123"}}}}});
  const ReportData data = analyse({run});
  EXPECT_EQ(test_files::cell(provenance_table(data), data.runs[0].label, "series").text,
            data.runs[0].series_hash + " (from gauges.csv fnv1a64:0123)");
  EXPECT_EQ(data.runs[0].series_hash.substr(0, 8), "fnv1a64:");
}

TEST(Doubts, FurtherMeasuredFilesOfARunAreShownByTheirHashes) {
  const fs::path run = fresh("doubts_further_files");
  synthetic::write_force_run(run, {});
  put_in_manifest(run, {{"data_hash", "fnv1a64:01"}, {"other_data_hashes", {{"data/a/velocity.csv", "fnv1a64:23"}}}});
  EXPECT_EQ(test_files::cell(provenance_table(analyse({run})), "R1", "data_hash").text,
            "fnv1a64:01, fnv1a64:23 (data/a/velocity.csv)");
}

/// The case leaves the speed of sound to the solver: one that was given makes another method.
TEST(Doubts, AParameterThatTheCaseDoesNotListIsShownToo) {
  const fs::path usual = fresh("doubts_usual");
  const fs::path slow = fresh("doubts_slow");
  for (const fs::path& run : {usual, slow}) {
    synthetic::write_run(run, {});
    const double speed_of_sound_m_s = run == slow ? 20.0 : 20 * std::sqrt(9.81 * 0.55);
    put_in_manifest(run, {{"parameters", {{"speed_of_sound_m_s", speed_of_sound_m_s}}}});
  }
  const ReportData data = analyse({usual, slow});
  for (const AnalysedRun& run : data.runs)
    EXPECT_EQ(run.label.find("speed_of_sound_m_s = 20") != std::string::npos, run.record.path == slow) << run.label;
  for (const BiasQuantity& quantity : bias_quantities(data)) EXPECT_EQ(quantity.methods.size(), 2u) << quantity.name;
}

std::vector<fs::path> three_distances(const std::string& name) {
  std::vector<fs::path> directories;
  MadeForceRun run;
  for (const double l0_m : {0.02, 0.0125, 0.01}) {
    run.l0_m = l0_m;
    directories.push_back(fresh(name + std::to_string(directories.size())));
    synthetic::write_force_run(directories.back(), run);
  }
  return directories;
}

TEST(Doubts, AStudyOfRunsOfSeveralBuildsSaysSo) {
  const auto directories = three_distances("doubts_builds");
  EXPECT_TRUE(mixed_builds(analyse(directories)).empty());
  put_in_manifest(directories[1], {{"commit", "abcdef0123456789"}});
  const auto texts = mixed_builds(analyse(directories));
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_TRUE(texts[0].starts_with("The study of resolution (")) << texts[0];
  EXPECT_TRUE(any_has(texts, "abcdef012345 (R2)")) << texts[0];
}

TEST(Doubts, OfTwoRunsAtOneDistanceTheSecondIsNamedAsLeftOut) {
  auto directories = three_distances("doubts_double");
  directories.push_back(fresh("doubts_double_again"));
  MadeForceRun run;
  run.l0_m = 0.01;
  synthetic::write_force_run(directories.back(), run);
  const Table table = resolution_table(analyse(directories));
  EXPECT_TRUE(any_has(table.notes, "is left out: another run at its particle distance"));
}

TEST(Doubts, AnAblationIsAMethodOfItsOwnInBiasAndScatter) {
  MadeForceRun run;
  const fs::path plain = fresh("doubts_bias");
  const fs::path cut = fresh("doubts_bias_cut");
  synthetic::write_force_run(plain, run);
  run.parameters = {{"delta", 0.0}};
  synthetic::write_force_run(cut, run);
  const auto quantities = bias_quantities(analyse({plain, cut}));
  ASSERT_FALSE(quantities.empty());
  ASSERT_EQ(quantities[0].methods.size(), 2u);
  EXPECT_NE((quantities[0].methods[0].name + quantities[0].methods[1].name).find("delta = 0"), std::string::npos);
}

TEST(Doubts, PairsThatAreNotPositiveDoNotCountAndAreTold) {
  std::vector<fs::path> runs;
  for (const double scale : {1.0, 1.1, -1.0, -1.1}) {
    runs.push_back(fresh("doubts_pairs_" + std::to_string(runs.size())));
    synthetic::write_force_run(runs.back(), {.alpha = 0.01 * static_cast<double>(runs.size()), .scale = scale});
  }
  const Table table = bias_table(analyse(runs));
  EXPECT_EQ(*test_files::cell(table, "WCSPH", "pairs").value, 2);
  EXPECT_EQ(test_files::cell(table, "WCSPH", "bias").text, "needs three pairs");
  EXPECT_TRUE(any_has(table.notes, "walls: 2 pairs left out, a value in them is not positive"));
}

TEST(Doubts, WithoutOwnImpulsesThePapersAreNamedByThemselves) {
  const fs::path run = fresh("doubts_no_impulses");
  synthetic::write_external_run(run, 1);
  const std::vector<KeyNumber> keys = key_numbers(analyse({run}));
  const auto has = [&](const std::string& label) {
    return std::any_of(keys.begin(), keys.end(), [&](const KeyNumber& key) { return key.label == label; });
  };
  EXPECT_TRUE(has("Impulses of P1, P2 and P3 in the paper (WCSPH)"));
  EXPECT_FALSE(has("The same in the paper (WCSPH)"));
}

TEST(Doubts, OfAnotherVersionOfTheCaseFileIsWhatWasComputedFromOtherInputs) {
  const fs::path run = fresh("doubts_case");
  synthetic::write_run(run, {});
  const std::string other = "another version of the case file";
  EXPECT_FALSE(any_has(analyse({run}).runs[0].problems, other));
  put_in_manifest(run, {{"case_hash", "of before"}});
  EXPECT_TRUE(any_has(analyse({run}).runs[0].problems, other)) << "a run that does not tell more";
  put_in_manifest(run, {{"computed_hash", load_case("kleefsman").computed_hash}});
  EXPECT_FALSE(any_has(analyse({run}).runs[0].problems, other)) << "another remark, or another band";
  put_in_manifest(run, {{"computed_hash", "of before"}});
  EXPECT_TRUE(any_has(analyse({run}).runs[0].problems, "which differs in what is computed"));
}

}  // namespace
}  // namespace sluice
