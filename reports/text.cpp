#include "reports/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "reports/replace_characters.h"

namespace sluice {

namespace {

constexpr const char* minus = "−";

std::string typographic(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, minus);
  return text;
}

std::string superscript(int exponent) {
  static const std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (char c : std::to_string(std::abs(exponent))) out += digits[static_cast<std::size_t>(c - '0')];
  return out;
}

}  // namespace

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  // No "-0.0": a sign without a digit says nothing.
  if (text.front() == '-' && text.find_first_of("123456789") == std::string::npos && std::isfinite(value))
    text.erase(0, 1);
  return typographic(text);
}

std::string shortest(double value) {
  if (value != 0 && std::abs(value) < 1e-3 && std::abs(value) >= 1e-6) {
    std::string text = fmt::format("{:.9f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    return typographic(text);
  }
  return typographic(fmt::format("{:g}", value));
}

std::string with_sign(double value, int decimals) {
  const std::string text = fixed(value, decimals);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return value > 0 && !zero ? "+" + text : text;
}

std::string scientific(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value);
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = text.find('e');
  return typographic(text.substr(0, e)) + "·10" + superscript(std::stoi(text.substr(e + 1)));
}

std::string significant(double value, int digits) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return fmt::format("{}", value);
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (exponent >= -3 && exponent < 6) return fixed(value, std::max(0, digits - 1 - exponent));
  return scientific(value, digits);
}

std::string duration(double seconds) {
  if (seconds < 120) return fixed(seconds, 1) + " s";
  const long long whole = std::llround(seconds);
  if (whole < 7200) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string grouped(long long value) {
  const std::string digits = std::to_string(std::llabs(value));
  std::string out = value < 0 ? minus : "";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += "\u202f";
    out += digits[i];
  }
  return out;
}

std::string bytes(double count) {
  static const std::array<const char*, 5> units = {"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  while (count >= 1000 && unit + 1 < units.size()) {
    count /= 1000;
    ++unit;
  }
  return fmt::format("{} {}", fixed(count, unit == 0 ? 0 : 1), units[unit]);
}

std::string escape_html(std::string_view text) {
  static constexpr std::array<Replacement, 5> map = {
      {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}}};
  return replace_characters(text, map);
}

std::string escape_markdown_cell(std::string_view text) {
  static constexpr std::array<Replacement, 7> map = {
      {{"|", "\\|"}, {"\n", " "}, {"*", "\\*"}, {"_", "\\_"}, {"<", "&lt;"}, {">", "&gt;"}, {"\u202f", " "}}};
  return replace_characters(text, map);
}

std::string escape_csv(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  static constexpr std::array<Replacement, 1> map = {{{"\"", "\"\""}}};
  return '"' + replace_characters(text, map) + '"';
}

std::string escape_gnuplot(std::string_view text) {
  // Enhanced text is read twice: once as a double-quoted string, once for markup; hence two backslashes. What stands
  // between backquotes in such a string would be run as a command.
  static constexpr std::array<Replacement, 11> map = {{{"\\", "/"},
                                                       {"`", "'"},
                                                       {"\r", " "},
                                                       {"\"", "''"},
                                                       {"_", "\\\\_"},
                                                       {"^", "\\\\^"},
                                                       {"{", "\\\\{"},
                                                       {"}", "\\\\}"},
                                                       {"@", "\\\\@"},
                                                       {"&", "\\\\&"},
                                                       {"\n", " "}}};
  return replace_characters(text, map);
}

std::string html_text(std::string_view text) {
  std::string out = escape_html(text);
  for (const auto& [from, to] :
       {Replacement{" = ", "\u00a0=\u00a0"}, Replacement{" mm", "\u00a0mm"}, Replacement{" ms", "\u00a0ms"},
        Replacement{" %", "\u00a0%"}, Replacement{" kPa", "\u00a0kPa"}, Replacement{"Pa s]", "Pa\u00a0s]"}})
    for (std::size_t at = out.find(from); at != std::string::npos; at = out.find(from, at + to.size()))
      out.replace(at, from.size(), to);
  return out;
}

namespace {

/// Replaces each pair of `mark` by an opening and a closing tag; a single mark stays as it is.
std::string paired(std::string_view text, std::string_view mark, std::string_view open, std::string_view close) {
  std::string out;
  std::size_t at = 0;
  while (true) {
    const std::size_t first = text.find(mark, at);
    const std::size_t second = first == std::string_view::npos ? first : text.find(mark, first + mark.size());
    if (second == std::string_view::npos) return out.append(text.substr(at));
    out.append(text.substr(at, first - at)).append(open);
    out.append(text.substr(first + mark.size(), second - first - mark.size())).append(close);
    at = second + mark.size();
  }
}

/// [words](#anchor) as an element; only anchors inside the page, since the page makes no requests.
std::string anchors(std::string_view text) {
  std::string out;
  std::size_t at = 0;
  while (true) {
    const std::size_t middle = text.find("](#", at);
    const std::size_t open = middle == std::string_view::npos ? middle : text.rfind('[', middle);
    const std::size_t close = middle == std::string_view::npos ? middle : text.find(')', middle);
    if (open == std::string_view::npos || close == std::string_view::npos || open < at)
      return out.append(text.substr(at));
    out.append(text.substr(at, open - at));
    out += fmt::format("<a href=\"{}\">{}</a>", text.substr(middle + 2, close - middle - 2),
                       text.substr(open + 1, middle - open - 1));
    at = close + 1;
  }
}

}  // namespace

std::string inline_html(std::string_view text) {
  const std::string code = paired(html_text(text), "`", "<code>", "</code>");
  return anchors(paired(code, "**", "<strong>", "</strong>"));
}

std::string slug(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

}  // namespace sluice
