#include "reports/text.h"

#include <gtest/gtest.h>

namespace sluice {
namespace {

TEST(Text, NumbersAreWrittenWithTypographicSigns) {
  EXPECT_EQ(fixed(-4.25, 1), "−4.2");
  EXPECT_EQ(fixed(-0.04, 1), "0.0") << "no sign on a zero";
  EXPECT_EQ(with_sign(4.0, 1), "+4.0");
  EXPECT_EQ(with_sign(0.0, 1), "0.0");
  EXPECT_EQ(with_sign(-27.51, 1), "−27.5");
  EXPECT_EQ(shortest(0.0001), "0.0001");
  EXPECT_EQ(shortest(-0.00025), "−0.00025");
  EXPECT_EQ(shortest(20), "20");
}

TEST(Text, SignificantDigitsAndPowersOfTen) {
  EXPECT_EQ(significant(5.24e-4, 2), "5.2·10⁻⁴");
  EXPECT_EQ(significant(1630000.0, 2), "1.6·10⁶");
  EXPECT_EQ(significant(0.0075, 2), "0.0075");
  EXPECT_EQ(significant(13392.0, 3), "13392");
  EXPECT_EQ(significant(-0.02, 1), "−0.02");
  EXPECT_EQ(significant(0.0, 3), "0");
}

TEST(Text, DurationsBytesAndThousands) {
  EXPECT_EQ(duration(12.34), "12.3 s");
  EXPECT_EQ(duration(247), "4 min 07 s");
  EXPECT_EQ(duration(126000), "35 h 00 min");
  EXPECT_EQ(bytes(12.3e6), "12.3 MB");
  EXPECT_EQ(grouped(84000), "84\u202f000");
  EXPECT_EQ(grouped(-1234567), "−1\u202f234\u202f567");
}

TEST(Text, EscapesForEachFormat) {
  EXPECT_EQ(escape_html("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
  EXPECT_EQ(escape_latex("50 % of R_1 & {α}"), "50 \\% of R\\_1 \\& \\{$\\alpha$\\}");
  EXPECT_EQ(escape_latex("a\\b^c~d"), "a\\textbackslash{}b\\textasciicircum{}c\\textasciitilde{}d");
  EXPECT_EQ(escape_latex("|x|"), "$|$x$|$") << "a bare bar is a dash in LaTeX's oldest fonts";
  EXPECT_EQ(escape_latex("\u03b4\u03bb-SPH Müller"), "$\\delta$$\\lambda$-SPH Müller");
  EXPECT_EQ(escape_latex("流"), "[U+6D41]") << "LaTeX would stop at it";
  EXPECT_EQ(escape_csv("plain"), "plain");
  EXPECT_EQ(escape_csv("a,\"b\""), "\"a,\"\"b\"\"\"");
  EXPECT_EQ(escape_markdown_cell("a|b*c_d"), "a\\|b\\*c\\_d");
  EXPECT_EQ(escape_gnuplot("l_0 \"x\""), "l\\\\_0 ''x''");
  EXPECT_EQ(escape_gnuplot("a`touch x`\rb"), "a'touch x' b") << "would be run as a command";
}

TEST(Text, InlineMarksBecomeElementsAndNothingElseDoes) {
  EXPECT_EQ(inline_html("**so** `x<y` [rows](#acceptance)"),
            "<strong>so</strong> <code>x&lt;y</code> <a href=\"#acceptance\">rows</a>");
  EXPECT_EQ(inline_html("a ** b"), "a ** b");
  EXPECT_EQ(inline_html("[x](http://elsewhere)"), "[x](http://elsewhere)") << "only anchors of the page become links";
}

TEST(Text, NumbersStayWithTheirUnitsOnThePage) {
  EXPECT_EQ(html_text("α = 0.1, l0 = 20 mm & 5 %"), "α\u00a0=\u00a00.1, l0\u00a0=\u00a020\u00a0mm &amp; 5\u00a0%");
}

TEST(Text, SlugsAreSafeFileNames) {
  EXPECT_EQ(slug("P1 [Pa s], α"), "p1_pa_s");
}

}  // namespace
}  // namespace sluice
