#include "validation/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "validation/case.h"
#include "validation/printable.h"
#include "validation/suggest.h"

namespace sluice {
namespace {

constexpr std::size_t longest_case_error = 1500;

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a truth value";
    default:
      return "a date or time";
  }
}

/// Index behind the string that begins at `at`, or the text's size when it has no end.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string marks(text.substr(at, 3) == std::string(3, quote) ? 3 : 1, quote);
  for (std::size_t i = at + marks.size(); i < text.size(); ++i) {
    if (text.substr(i, marks.size()) == marks) return i + marks.size();
    if (text[i] == '\n' && marks.size() == 1) return i;
    if (text[i] == '\\' && quote == '"') ++i;
  }
  return text.size();
}

/// The library takes tables apart by recursion, so that a key of a hundred thousand parts would overflow the stack.
void refuse_deep_keys(std::string_view text, const std::string& file) {
  constexpr int most_dots = 20;
  int dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char ch = text[i];
    if (ch == '"' || ch == '\'') {
      i = end_of_string(text, i) - 1;
    } else if (ch == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (std::string_view("\n=,{}[]").find(ch) != std::string_view::npos) {
      dots = 0;
    } else if (ch == '.' && ++dots > most_dots) {
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
      throw_case_error(file, static_cast<int>(line), "syntax", fmt::format("a key of more than {} parts", most_dots));
    }
  }
}

int line_of(const toml::node& node) {
  return static_cast<int>(node.source().begin.line);
}

}  // namespace

void throw_case_error(const std::string& file, int line, std::string_view key, std::string_view message) {
  throw CaseError(fmt::format("{}:{}: {}: {}", file, line, printable(key), printable(message, longest_case_error)));
}

toml::table parse_toml(std::string_view text, const std::string& file) {
  refuse_deep_keys(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw_case_error(file, static_cast<int>(error.source().begin.line), "syntax", error.description());
  }
}

std::string read_text(const std::filesystem::path& file, std::string_view remedy) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() == std::ifstream::traits_type::eof() && !in.bad())  // bad: a directory
    throw CaseError(fmt::format("{}: is empty ({})", file.string(), remedy));
  if (!in || !(text << in.rdbuf())) throw CaseError(fmt::format("{}: cannot be read ({})", file.string(), remedy));
  return text.str();
}

Case load_case_for(const TomlReader& reader, const std::string& name_or_path) {
  try {
    return load_case(name_or_path);
  } catch (const CaseError& error) {
    reader.fail("case", error.what());
  }
}

TomlReader::TomlReader(const toml::table& table, std::string file, std::string path)
    : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

std::string TomlReader::path_to(std::string_view key) const {
  if (key.empty()) return path_;
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TomlReader::fail(std::string_view key, std::string_view message) const {
  const toml::node* node = key.empty() ? nullptr : table_->get(key);
  throw_case_error(file_, node != nullptr ? line_of(*node) : line(), path_to(key), message);
}

bool TomlReader::has(std::string_view key) {
  asked_.emplace_back(key);
  return table_->contains(key);
}

const toml::node& TomlReader::require(std::string_view key, std::string_view what) {
  if (!has(key)) fail(key, fmt::format("is missing (add `{} = ...`, {})", key, what));
  return *table_->get(key);
}

double TomlReader::finite(const toml::node& node, std::string_view key) const {
  const auto value = node.value<double>();
  if (!node.is_number() || !value)
    throw_case_error(file_, line_of(node), path_to(key), fmt::format("is {}, must be a number", type_name(node)));
  if (!std::isfinite(*value))
    throw_case_error(file_, line_of(node), path_to(key), "is not finite (give an ordinary number)");
  return *value;
}

double TomlReader::number(std::string_view key) {
  return finite(require(key, "a number"), key);
}

double TomlReader::positive_number(std::string_view key) {
  const double value = number(key);
  if (value <= 0) fail(key, fmt::format("is {}, must be greater than zero", value));
  return value;
}

double TomlReader::number_or(std::string_view key, double fallback) {
  return has(key) ? number(key) : fallback;
}

std::optional<double> TomlReader::optional_number(std::string_view key) {
  if (!has(key)) return std::nullopt;
  return number(key);
}

int TomlReader::integer(std::string_view key) {
  const toml::node& node = require(key, "an integer");
  if (!node.is_integer()) fail(key, fmt::format("is {}, must be an integer", type_name(node)));
  const auto value = node.value<int>();
  if (!value) fail(key, fmt::format("is {}, too large", *node.value<std::int64_t>()));
  return *value;
}

std::string TomlReader::text(std::string_view key) {
  const toml::node& node = require(key, "a string");
  if (!node.is_string()) fail(key, fmt::format("is {}, must be a string", type_name(node)));
  auto value = *node.value<std::string>();
  if (value.empty()) fail(key, "is empty (give it a value)");
  return value;
}

std::string TomlReader::text_or(std::string_view key, std::string fallback) {
  return has(key) ? text(key) : std::move(fallback);
}

std::vector<double> TomlReader::numbers(std::string_view key) {
  const toml::node& node = require(key, "an array of numbers");
  if (!node.is_array()) fail(key, fmt::format("is {}, must be an array of numbers", type_name(node)));
  std::vector<double> values;
  for (const toml::node& element : *node.as_array()) values.push_back(finite(element, key));
  return values;
}

bool TomlReader::flag_or(std::string_view key, bool fallback) {
  if (!has(key)) return fallback;
  const toml::node& node = require(key, "true or false");
  if (!node.is_boolean()) fail(key, fmt::format("is {}, must be true or false", type_name(node)));
  return *node.value<bool>();
}

std::vector<std::string> TomlReader::texts(std::string_view key) {
  const toml::node& node = require(key, "an array of strings");
  if (!node.is_array()) fail(key, fmt::format("is {}, must be an array of strings", type_name(node)));
  std::vector<std::string> values;
  for (const toml::node& element : *node.as_array()) {
    if (!element.is_string()) fail(key, fmt::format("holds {}, must hold strings only", type_name(element)));
    values.push_back(*element.value<std::string>());
  }
  return values;
}

std::pair<double, double> TomlReader::range(std::string_view key) {
  const std::vector<double> values = numbers(key);
  if (values.size() != 2) fail(key, fmt::format("has {} numbers, must have two: [from, to]", values.size()));
  if (values[0] > values[1]) fail(key, fmt::format("runs from {} down to {} (exchange them)", values[0], values[1]));
  return {values[0], values[1]};
}

std::vector<std::pair<double, double>> TomlReader::ranges(std::string_view key) {
  constexpr const char* wanted = "an array of pairs such as [[0.3, 1.3], [1.4, 2.3]]";
  const toml::node& node = require(key, wanted);
  if (!node.is_array()) fail(key, fmt::format("is {}, must be {}", type_name(node), wanted));
  std::vector<std::pair<double, double>> pairs;
  for (const toml::node& element : *node.as_array()) {
    const toml::array* pair = element.as_array();
    if (pair == nullptr || pair->size() != 2) fail(key, fmt::format("holds no pair, must be {}", wanted));
    pairs.emplace_back(finite((*pair)[0], key), finite((*pair)[1], key));
    if (pairs.back().first > pairs.back().second)
      fail(key, fmt::format("runs from {} down to {} (exchange them)", pairs.back().first, pairs.back().second));
  }
  return pairs;
}

Vec3d TomlReader::vec3(std::string_view key) {
  const std::vector<double> values = numbers(key);
  if (values.size() != 3) fail(key, fmt::format("has {} numbers, must have three: [x, y, z]", values.size()));
  return {values[0], values[1], values[2]};
}

TomlReader TomlReader::table(std::string_view key) {
  const toml::node& node = require(key, "a table");
  if (!node.is_table()) fail(key, fmt::format("is {}, must be a table", type_name(node)));
  return {*node.as_table(), file_, path_to(key)};
}

std::vector<TomlReader> TomlReader::tables(std::string_view key, bool may_be_absent) {
  if (may_be_absent && !has(key)) return {};
  const toml::node& node = require(key, "an array of tables");
  if (!node.is_array()) fail(key, fmt::format("is {}, must be an array of tables", type_name(node)));
  std::vector<TomlReader> readers;
  for (const toml::node& element : *node.as_array()) {
    if (!element.is_table())
      throw_case_error(file_, line_of(element), path_to(key),
                       fmt::format("holds {}, must hold tables only", type_name(element)));
    readers.emplace_back(*element.as_table(), file_, fmt::format("{}[{}]", path_to(key), readers.size()));
  }
  if (readers.empty() && !may_be_absent) fail(key, "is empty, must have at least one entry");
  return readers;
}

std::vector<std::pair<std::string, double>> TomlReader::all_numbers() {
  std::vector<std::pair<std::string, double>> values;
  for (const auto& [key, node] : *table_) values.emplace_back(key.str(), number(key.str()));
  return values;
}

void TomlReader::finish() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(asked_.begin(), asked_.end(), key.str()) == asked_.end())
      throw_case_error(file_, line_of(node), path_to(key.str()), "unknown key" + suggestion(key.str(), asked_));
  }
}

}  // namespace sluice
