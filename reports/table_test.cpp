#include "reports/table.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace sluice {
namespace {

Table sample() {
  Table table;
  table.name = "sample_1";
  table.caption = "Loads & 50 %";
  table.columns = {{"Run", "run", false}, {"P1 [Pa s]", "P1_Pa_s"}};
  table.add_group("wall|walls, \"both\"");
  table.add({word("R_1 <a>"), number(13391.654321, 0)});
  table.add({word("R_2", Tone::strong), missing()});
  table.notes = {"50 % of it"};
  return table;
}

TEST(Table, MarkdownHasOneLineARowAndEscapesCells) {
  EXPECT_EQ(to_markdown(sample()),
            "**Loads & 50 %**\n\n| Run | P1 [Pa s] |\n|---|---:|\n| **wall\\|walls, \"both\"** |  |\n"
            "| R\\_1 &lt;a&gt; | 13392 |\n| **R\\_2** | missing |\n\n50 % of it\n");
}

TEST(Table, CsvKeepsFullPrecisionAndNamesGroups) {
  EXPECT_EQ(to_csv(sample()),
            "group,run,P1_Pa_s\n\"wall|walls, \"\"both\"\"\",R_1 <a>,13391.65432\n"
            "\"wall|walls, \"\"both\"\"\",R_2,\n")
      << "what is missing is an empty field, never a zero";
}

TEST(Table, LatexEscapesAndUsesBooktabs) {
  const std::string latex = to_latex(sample());
  for (const char* part : {"\\toprule", "\\midrule", "\\bottomrule", "Loads \\& 50 \\%", "R\\_1 $<$a$>$ & 13392 \\\\",
                           "\\textbf{R\\_2} & \\textit{missing} \\\\", "\\label{tab:sample_1}", "{@{}lr@{}}"})
    EXPECT_NE(latex.find(part), std::string::npos) << part << "\n" << latex;
}

/// `\\` and `\midrule` take what stands in brackets after them for a length.
TEST(Table, LatexRowsMayBeginWithABracketOrAStar) {
  Table table;
  table.name = "bracket";
  table.columns = {{"[unit]", "unit", false}, {"n", "n"}};
  table.add({word("[m]"), number(1, 0)});
  table.add({word("*"), number(2, 0)});
  const std::string latex = to_latex(table);
  for (const char* part : {"\n{}[unit] & n", "\n{}[m] & 1", "\n{}* & 2"})
    EXPECT_NE(latex.find(part), std::string::npos) << part << "\n" << latex;
}

TEST(Table, LatexBreaksLongTablesAcrossPages) {
  Table table = sample();
  EXPECT_EQ(to_latex(table).find("\\begin{longtable}"), std::string::npos);
  for (int i = 0; i < 60; ++i) table.add({word("R"), number(i, 0)});
  const std::string latex = to_latex(table);
  EXPECT_NE(latex.find("\\begin{longtable}{@{}lr@{}}"), std::string::npos);
  EXPECT_EQ(latex.find("\\resizebox"), std::string::npos);
}

TEST(Table, HtmlEscapesAndMarksMissing) {
  const std::string html = to_html(sample());
  EXPECT_NE(html.find("<th scope=\"row\">R_1 &lt;a&gt;</th><td class=\"n\">13392</td>"), std::string::npos) << html;
  EXPECT_NE(html.find("<td class=\"n missing\">missing</td>"), std::string::npos);
  EXPECT_NE(html.find("Loads &amp; 50\u00a0%"), std::string::npos);
  EXPECT_EQ(html.find("<details"), std::string::npos);
}

TEST(Table, FoldedTablesHideTheirRows) {
  Table table = sample();
  table.folded = true;
  EXPECT_NE(to_html(table).find("<details><summary>Loads &amp; 50\u00a0% (3 rows)</summary>"), std::string::npos);
}

TEST(Table, ValuesThatAreNotFiniteAreMissing) {
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN(), 1).text, "missing");
  EXPECT_EQ(number(std::optional<double>(), 1).text, "missing");
  EXPECT_EQ(signed_number(4.04, 1).text, "+4.0");
  EXPECT_EQ(rounded(5.2e-4, 2).text, "5.2·10⁻⁴");
}

TEST(Table, RowsOfTheWrongLengthAreRefused) {
  Table table = sample();
  EXPECT_THROW(table.add({word("a"), word("b"), word("c")}), std::logic_error);
}

}  // namespace
}  // namespace sluice
