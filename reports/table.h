// A table that renders itself as Markdown, CSV, LaTeX and HTML. Cells carry what is shown and, for numbers, the value
// at full precision: people read the first, scripts read the second from the CSV.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sluice {

enum class Tone { plain, good, bad, missing, strong };

struct TableCell {
  std::string text;
  std::optional<double> value;  ///< written to the CSV in place of the text
  Tone tone = Tone::plain;
};

TableCell word(std::string text, Tone tone = Tone::plain);
/// A number with `decimals` digits shown; not a finite number: missing.
TableCell number(double value, int decimals);
TableCell number(std::optional<double> value, int decimals);
/// A number with its sign shown always.
TableCell signed_number(std::optional<double> value, int decimals);
/// A number with `digits` significant digits shown.
TableCell rounded(std::optional<double> value, int digits);
/// A number as it was typed: "0.0001".
TableCell typed(std::optional<double> value);
/// A value that no run or file told: the word "missing", an empty field in the CSV.
TableCell missing();
/// A value that makes no sense here (a time of a peak where there is no peak): a dash.
TableCell not_applicable(std::string why = "–");

struct TableColumn {
  std::string heading;   ///< as read by people, with its unit: "P1 [Pa s]"
  std::string csv_name;  ///< as read by scripts: "P1_Pa_s"; empty: made from the heading
  bool numeric = true;   ///< aligned right
};

struct TableRow {
  std::vector<TableCell> cells;  ///< one a column; one cell alone is a heading that spans the table
  bool is_group() const { return cells.size() == 1; }
};

struct Table {
  std::string name;  ///< file stem, such as "table2_impulses"
  std::string caption;
  std::vector<TableColumn> columns;
  std::vector<TableRow> rows;
  std::vector<std::string> notes;  ///< below the table
  bool folded = false;             ///< long: the page shows its caption alone until it is asked for

  /// Throws std::logic_error when the row's length is not the number of columns.
  void add(std::vector<TableCell> cells);
  void add_group(std::string heading);
};

std::string to_markdown(const Table& table);
/// One header line, one line a row; group headings become the first column "group".
std::string to_csv(const Table& table);
/// A booktabs table that compiles on its own and can be taken into a document with \input (needs booktabs,
/// graphicx, longtable).
std::string to_latex(const Table& table);
std::string to_html(const Table& table);

}  // namespace sluice
