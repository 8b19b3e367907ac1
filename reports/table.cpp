#include "reports/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "reports/text.h"

namespace sluice {

TableCell word(std::string text, Tone tone) {
  return {std::move(text), std::nullopt, tone};
}
TableCell missing() {
  return {"missing", std::nullopt, Tone::missing};
}
TableCell not_applicable(std::string why) {
  return {std::move(why), std::nullopt, Tone::plain};
}

namespace {

bool known(const std::optional<double>& value) {
  return value && std::isfinite(*value);
}

}  // namespace

TableCell number(double value, int decimals) {
  return number(std::optional<double>(value), decimals);
}

TableCell number(std::optional<double> value, int decimals) {
  if (!known(value)) return missing();
  return {fixed(*value, decimals), value, Tone::plain};
}

TableCell signed_number(std::optional<double> value, int decimals) {
  if (!known(value)) return missing();
  return {with_sign(*value, decimals), value, Tone::plain};
}

TableCell rounded(std::optional<double> value, int digits) {
  if (!known(value)) return missing();
  return {significant(*value, digits), value, Tone::plain};
}

TableCell typed(std::optional<double> value) {
  if (!known(value)) return missing();
  return {shortest(*value), value, Tone::plain};
}

void Table::add(std::vector<TableCell> cells) {
  if (cells.size() != columns.size())
    throw std::logic_error(
        fmt::format("table {}: a row of {} cells, but {} columns", name, cells.size(), columns.size()));
  rows.push_back({std::move(cells)});
}

void Table::add_group(std::string heading) {
  rows.push_back({{word(std::move(heading), Tone::strong)}});
}

std::string to_markdown(const Table& table) {
  std::string out = fmt::format("**{}**\n\n|", table.caption);
  for (const TableColumn& column : table.columns) out += fmt::format(" {} |", escape_markdown_cell(column.heading));
  out += "\n|";
  for (const TableColumn& column : table.columns) out += column.numeric ? "---:|" : "---|";
  out += "\n";
  for (const TableRow& row : table.rows) {
    out += "|";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const std::string text = c < row.cells.size() ? escape_markdown_cell(row.cells[c].text) : "";
      const bool strong = c < row.cells.size() && row.cells[c].tone == Tone::strong;
      out += strong ? fmt::format(" **{}** |", text) : fmt::format(" {} |", text);
    }
    out += "\n";
  }
  for (const std::string& note : table.notes) out += fmt::format("\n{}\n", note);
  return out;
}

namespace {

std::string csv_field(const TableCell& cell) {
  if (cell.value) return fmt::format("{:.10g}", *cell.value);
  return cell.tone == Tone::missing ? "" : escape_csv(cell.text);
}

bool has_groups(const Table& table) {
  return std::any_of(table.rows.begin(), table.rows.end(), [](const TableRow& row) { return row.is_group(); });
}

}  // namespace

std::string to_csv(const Table& table) {
  const bool groups = has_groups(table);
  std::string out = groups ? "group" : "";
  for (const TableColumn& column : table.columns) {
    if (!out.empty()) out += ',';
    out += escape_csv(column.csv_name.empty() ? slug(column.heading) : column.csv_name);
  }
  out += '\n';
  std::string group;
  for (const TableRow& row : table.rows) {
    if (row.is_group()) {
      group = escape_csv(row.cells.front().text);
      continue;
    }
    if (groups) out += group + ',';
    for (std::size_t c = 0; c < row.cells.size(); ++c) out.append(c > 0 ? "," : "").append(csv_field(row.cells[c]));
    out += '\n';
  }
  return out;
}

namespace {

std::string latex_cell(const TableCell& cell) {
  std::string text = escape_latex(cell.text);
  if (cell.tone == Tone::strong) return "\\textbf{" + text + "}";
  if (cell.tone == Tone::missing) return "\\textit{" + text + "}";
  return text;
}

// After \begin{document} LaTeX itself makes \@nodocument \relax: that tells a file taken in with \input from one that
// is compiled alone, without asking anything of the document that takes it in.
constexpr const char* latex_head =
    R"(% Compiles alone; in a document: \usepackage{booktabs,graphicx,longtable} and \input this file.
\expandafter\ifx\csname @nodocument\endcsname\relax\else
\documentclass{article}
\usepackage[T1]{fontenc}
\usepackage[utf8]{inputenc}
\usepackage[a4paper,landscape,margin=15mm]{geometry}
\usepackage{booktabs,graphicx,longtable}
\begin{document}
\def\sluicealone{\end{document}}
\fi
)";
constexpr const char* latex_foot = "\\ifdefined\\sluicealone\\expandafter\\sluicealone\\fi\n";

/// Begins a row: a first cell that begins with a bracket or a star would be taken for an argument of what stands
/// before.
constexpr const char* latex_row_begin = "{}";

/// Tables of more rows than a page holds are set small and break across pages.
constexpr std::size_t rows_on_a_page = 36;

std::string latex_heading(const Table& table) {
  std::string out;
  for (const TableColumn& column : table.columns)
    out += (out.empty() ? latex_row_begin : " & ") + escape_latex(column.heading);
  return out + " \\\\\n\\midrule\n";
}

std::string latex_rows(const Table& table) {
  std::string out;
  for (const TableRow& row : table.rows) {
    if (row.is_group()) {
      out += fmt::format("\\addlinespace\\multicolumn{{{}}}{{@{{}}l}}{{{}}} \\\\\n", table.columns.size(),
                         latex_cell(row.cells.front()));
      continue;
    }
    for (std::size_t c = 0; c < row.cells.size(); ++c)
      out.append(c > 0 ? " & " : latex_row_begin).append(latex_cell(row.cells[c]));
    out += " \\\\\n";
  }
  return out;
}

std::string latex_notes(const Table& table) {
  std::string out;
  for (const std::string& note : table.notes)
    out += fmt::format("\\par\\smallskip{{\\footnotesize {}\\par}}\n", escape_latex(note));
  return out;
}

}  // namespace

std::string to_latex(const Table& table) {
  std::string alignment;
  for (const TableColumn& column : table.columns) alignment += column.numeric ? 'r' : 'l';
  const std::string caption =
      fmt::format("\\caption{{{}}}\\label{{tab:{}}}", escape_latex(table.caption), slug(table.name));
  std::string out = latex_head;
  if (table.rows.size() > rows_on_a_page) {
    out += fmt::format("\\begingroup\\tiny\\setlength{{\\tabcolsep}}{{2.5pt}}\n\\begin{{longtable}}{{@{{}}{}@{{}}}}\n",
                       alignment);
    out += caption + "\\\\\n\\toprule\n" + latex_heading(table) + "\\endhead\n" + latex_rows(table);
    out += "\\bottomrule\n\\end{longtable}\n" + latex_notes(table) + "\\endgroup\n";
  } else {
    out += fmt::format("\\begin{{table}}[htbp]\n\\centering\n{}\n", caption);
    out += "\\resizebox{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}{!}{%\n";
    out += fmt::format("\\begin{{tabular}}{{@{{}}{}@{{}}}}\n\\toprule\n", alignment);
    out += latex_heading(table) + latex_rows(table) + "\\bottomrule\n\\end{tabular}}\n";
    out += latex_notes(table) + "\\end{table}\n";
  }
  return out + latex_foot;
}

namespace {

const char* css_class(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "good";
    case Tone::bad:
      return "bad";
    case Tone::missing:
      return "missing";
    case Tone::strong:
      return "strong";
    case Tone::plain:
      break;
  }
  return "";
}

/// Hashes, versions and paths: on paper they may break anywhere.
bool has_long_word(std::string_view text) {
  constexpr std::size_t longest = 14;
  while (text.size() > longest) {
    const std::size_t word = std::min(text.find(' '), text.size());
    if (word > longest) return true;
    text.remove_prefix(std::min(word + 1, text.size()));
  }
  return false;
}

std::string html_row(const Table& table, const TableRow& row) {
  if (row.is_group())
    return fmt::format("<tr class=\"group\"><th scope=\"rowgroup\" colspan=\"{}\"><span>{}</span></th></tr>\n",
                       table.columns.size(), html_text(row.cells.front().text));
  std::string out = "<tr>";
  for (std::size_t c = 0; c < row.cells.size(); ++c) {
    const TableCell& cell = row.cells[c];
    std::string classes = table.columns[c].numeric ? "n" : "";
    if (cell.tone != Tone::plain) classes += std::string(classes.empty() ? "" : " ") + css_class(cell.tone);
    if (!table.columns[c].numeric && has_long_word(cell.text)) classes += classes.empty() ? "long" : " long";
    const std::string attribute = classes.empty() ? "" : " class=\"" + classes + "\"";
    out += c == 0 ? fmt::format("<th scope=\"row\"{}>{}</th>", attribute, html_text(cell.text))
                  : fmt::format("<td{}>{}</td>", attribute, html_text(cell.text));
  }
  return out + "</tr>\n";
}

}  // namespace

std::string to_html(const Table& table) {
  const std::string caption = inline_html(table.caption);
  std::string out = fmt::format("<figure class=\"table\" id=\"table-{}\">\n", slug(table.name));
  out += table.folded ? fmt::format("<details><summary>{} ({} rows)</summary>\n", caption, table.rows.size())
                      : fmt::format("<figcaption>{}</figcaption>\n", caption);
  out += "<div class=\"scroll\" tabindex=\"0\"><table>\n<thead><tr>";
  for (const TableColumn& column : table.columns)
    out += fmt::format("<th scope=\"col\"{}>{}</th>", column.numeric ? " class=\"n\"" : "", html_text(column.heading));
  out += "</tr></thead>\n<tbody>\n";
  for (const TableRow& row : table.rows) out += html_row(table, row);
  out += "</tbody></table></div>\n";
  for (const std::string& note : table.notes) out += fmt::format("<p class=\"note\">{}</p>\n", inline_html(note));
  return out + (table.folded ? "</details>\n</figure>\n" : "</figure>\n");
}

}  // namespace sluice
