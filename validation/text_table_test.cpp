#include "validation/text_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace sluice {
namespace {

/// What reading a table with the columns t and p, without header, complains of.
std::string complaint(std::string_view text, const RowForm& form = {}) {
  try {
    TextTableReader("x.csv", text).read_rows({"t", "p"}, form, 0);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(TextTable, ATextReadsLikeAFile) {
  const std::string text = "t,p\n0,1\n0.5,2";
  const auto path = std::filesystem::path(testing::TempDir()) / "sluice_text_table.csv";
  std::ofstream(path) << text;
  TextTableReader file(path);
  TextTableReader memory(path, text);
  EXPECT_EQ(file.next_header_line(), memory.next_header_line());
  EXPECT_EQ(file.read_rows({"t", "p"}, ',', 0), memory.read_rows({"t", "p"}, ',', 0));
  std::filesystem::remove(path);
}

TEST(TextTable, ANulByteIsNoEndOfALine) {
  using namespace std::string_literals;
  EXPECT_EQ(complaint("0,1\n1,2\0,3\n"s),
            "x.csv:2: a NUL byte: this is no plain text (UTF-16 or binary?); save the file as text in UTF-8");
  EXPECT_TRUE(complaint("\xff\xfet\0,\0p\0\n\0"s).starts_with("x.csv:1: a NUL byte"));
}

TEST(TextTable, MixedSeparatorsAreNamed) {
  EXPECT_EQ(complaint("0;1,2\n"),
            "x.csv:1: t: \"0;1\" is not a number; it holds a separator: write one and the same between all columns");
  EXPECT_EQ(
      complaint("0,1\n1,2\t3\n"),
      "x.csv:2: p: \"2\\x093\" is not a number; it holds a separator: write one and the same between all columns");
  EXPECT_EQ(complaint("0,5;1,5\n", {.separator = ';'}),
            "x.csv:1: t: \"0,5\" is not a number; write numbers with a decimal point, or announce decimal commas");
  EXPECT_TRUE(complaint("0;1\n1,5,2\n", {.separator = ';', .decimal_comma = true})
                  .starts_with("x.csv:2: t: \"1.5,2\" is not a number"));
}

TEST(TextTable, APointIsNoDecimalPointWhereCommasAre) {
  EXPECT_TRUE(
      complaint("0,415;999\n0,416;11.239\n", {.separator = ';', .decimal_comma = true})
          .starts_with("x.csv:2: p: \"11.239\" has a point where decimal commas were announced; write thousands"));
}

TEST(TextTable, AnExponentMayBeginWithADAndNothingElse) {
  const auto columns = TextTableReader("x.csv", "0,1.5D-03\n1d0,2d+2\n").read_rows({"t", "p"}, ',', 0);
  EXPECT_EQ(columns[0].back(), 1.0);
  EXPECT_EQ(columns[1], (std::vector<double>{1.5e-3, 200}));
  for (const char* field : {"1D", "1e5D3", "D3", "1D3x", "nand", "1DD3"})
    EXPECT_TRUE(
        complaint(fmt::format("0,{}\n", field)).starts_with(fmt::format("x.csv:1: p: \"{}\" is not a number", field)));
  EXPECT_EQ(complaint("0,1D999\n"), "x.csv:1: p: \"1D999\" does not fit a double");
}

TEST(TextTable, SplitsWithRegardToQuotesWhereTold) {
  using Fields = std::vector<std::string>;
  EXPECT_EQ(split_fields("\"a,b\", c ,\"\"", ','), (Fields{"\"a", "b\"", "c", "\"\""}));
  EXPECT_EQ(split_fields("\"a,b\", c ,\"\"", ',', true), (Fields{"a,b", "c", ""}));
  EXPECT_EQ(split_fields("\"a\"\",\"\"b\",c", ',', true), (Fields{"a\"\",\"\"b", "c"})) << "doubled quotes end nothing";
  EXPECT_EQ(split_fields("\"a,b", ',', true), (Fields{"\"a", "b"})) << "one quote is none";
  EXPECT_EQ(split_fields("\t\"a\tb\"", '\t', true), (Fields{"", "a\tb"}));
  EXPECT_EQ(split_fields("5\" pipe,6\" pipe", ',', true), (Fields{"5\" pipe", "6\" pipe"}));
}

TEST(TextTable, MessagesStayReadable) {
  EXPECT_EQ(complaint("0,\x1b[2Jx\n").substr(0, 23), "x.csv:1: p: \"\\x1b[2Jx\" ");
  EXPECT_LT(complaint("0," + std::string(100'000, 'x') + "\n").size(), 400u);
}

TEST(TextTable, AVeryLongLineIsAnError) {
  EXPECT_EQ(complaint("0,1\n" + std::string(1 << 21, ' ')),
            "x.csv:1: the next line is longer than a megabyte; this is no table of numbers");
}

TEST(TextTable, AFileThatCannotBeReadToItsEndIsAnError) {
  if (!std::filesystem::exists("/proc/self/mem")) GTEST_SKIP() << "no /proc on this system";
  try {
    TextTableReader("/proc/self/mem").next_header_line();
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("/proc/self/mem: cannot be read to its end;")) << error.what();
  }
}

TEST(TextTable, ALongFileWithoutALastLineEndHasAllItsRows) {
  constexpr std::size_t rows = 100'000;
  std::string text;
  for (std::size_t i = 0; i < rows; ++i) text += fmt::format("{:<1000}\n", fmt::format("{},1", i));
  text.pop_back();
  const auto columns = TextTableReader("x.csv", text).read_rows({"t", "p"}, ',', 0);
  ASSERT_EQ(columns[0].size(), rows);
  EXPECT_EQ(columns[0].back(), rows - 1.0);
}

TEST(TextTable, ScalesOnlyWhatStaysClean) {
  std::vector<double> values{1, 2};
  rescale(values, -1, 1e3, "x.csv", "p");
  EXPECT_EQ(values, (std::vector<double>{0, 1000}));
  EXPECT_THROW(rescale(values, 0, 1e308, "x.csv", "p"), std::runtime_error);
  std::vector<double> times{1, 1 + 1e-9};
  EXPECT_THROW(rescale_times(times, 1e12, 1, "x.csv", "t"), std::runtime_error);
}

}  // namespace
}  // namespace sluice
