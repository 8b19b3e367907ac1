// Numbers as words of a table, and text made safe for Markdown, LaTeX, HTML and CSV.
// Display text is UTF-8 (minus signs, Greek letters, superscripts); each escape turns it into what its format needs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sluice {

/// The paper's name of a method.
inline std::string method_name(const std::string& solver) {
  return solver == "wcsph" ? "WCSPH" : solver == "mps" ? "MPS" : solver;
}

/// A value in another unit; what is missing stays so.
inline std::optional<double> scaled(std::optional<double> value, double factor) {
  if (value) *value *= factor;
  return value;
}

/// `decimals` digits after the point, with a typographic minus.
std::string fixed(double value, int decimals);
/// `digits` significant digits; powers of ten as "5.2·10⁻³" outside 1e-3 .. 1e6.
std::string significant(double value, int digits);
/// As typed: the shortest form, such as "0.0001" or "20".
std::string shortest(double value);
/// As `fixed`, with the sign always shown.
std::string with_sign(double value, int decimals);
/// Always with a power of ten: "5.2·10⁻³".
std::string scientific(double value, int digits);
/// Seconds as "35 h 12 min", "4 min 07 s" or "12.3 s".
std::string duration(double seconds);
/// Whole numbers with thin spaces between thousands.
std::string grouped(long long value);
/// Bytes as "12.3 MB" (powers of ten).
std::string bytes(double count);

/// How many characters UTF-8 text has: bytes that do not continue one.
std::size_t characters(std::string_view text);

std::string escape_html(std::string_view text);
std::string escape_markdown_cell(std::string_view text);
std::string escape_latex(std::string_view text);
std::string escape_csv(std::string_view text);
/// For double-quoted gnuplot strings, with the enhanced mode's own characters made literal.
std::string escape_gnuplot(std::string_view text);

/// Escaped, with "α = 0.01" and "20 mm" kept on one line.
std::string html_text(std::string_view text);

/// HTML of a paragraph: escaped, then `code`, **strong** and [words](#section) turned into elements.
std::string inline_html(std::string_view text);

/// Lower case, with everything that is not a letter or a digit as one underscore: for file names and anchors.
std::string slug(std::string_view text);

}  // namespace sluice
