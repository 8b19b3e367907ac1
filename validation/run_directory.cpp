#include "validation/run_directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "validation/printable.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Values are copied by recursion: without a limit a file could overflow the stack.
constexpr int deepest_nesting = 100;

/// Remedy for a manifest that is of no use as it stands.
constexpr std::string_view what_suffices =
    R"(correct it, or write { "case": "kleefsman", "solver": "name", "l0_m": 0.02 })";

const json* find(const json& root, std::string_view dotted) {
  const json* node = &root;
  while (!dotted.empty()) {
    const auto dot = dotted.find('.');
    const std::string key(dotted.substr(0, dot));
    if (!node->is_object() || !node->contains(key)) return nullptr;
    node = &node->at(key);
    dotted = dot == std::string_view::npos ? std::string_view{} : dotted.substr(dot + 1);
  }
  return node;
}

std::string manifest_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() == std::ifstream::traits_type::eof() && !in.bad())  // bad: a directory
    throw std::runtime_error(fmt::format("{}: is empty ({})", file.string(), what_suffices));
  if (!in || !(text << in.rdbuf()))
    throw std::runtime_error(fmt::format(
        "{}: no such file (a run directory needs run.json with \"case\", \"solver\" and \"l0_m\")", file.string()));
  return text.str();
}

json manifest_from(std::string_view text, const fs::path& file) {
  try {
    json manifest = json::parse(text, [&file](int depth, json::parse_event_t, const json&) {
      if (depth <= deepest_nesting) return true;
      throw std::runtime_error(
          fmt::format("{}: is nested deeper than {} levels ({})", file.string(), deepest_nesting, what_suffices));
    });
    if (!manifest.is_object())
      throw std::runtime_error(fmt::format("{}: is not a JSON object ({})", file.string(), what_suffices));
    return manifest;
  } catch (const json::exception& error) {
    // Its text begins with the exception's name in brackets.
    const std::string_view text = error.what();
    throw std::runtime_error(fmt::format("{}: is not valid JSON: {} ({})", file.string(),
                                         printable(text.substr(std::min(text.find("] ") + 2, text.size())), 500),
                                         what_suffices));
  }
}

template <class T>
T require(const std::optional<T>& value, const fs::path& file, const char* key, const char* example) {
  if (value) return *value;
  throw std::runtime_error(
      fmt::format("{}: {}: is missing or of the wrong type (add \"{}\": {})", file.string(), key, key, example));
}

}  // namespace

std::optional<double> RunRecord::number(std::string_view dotted) const {
  const json* node = find(manifest, dotted);
  if (node == nullptr || !node->is_number()) return std::nullopt;
  return node->get<double>();
}

std::optional<std::string> RunRecord::text(std::string_view dotted) const {
  const json* node = find(manifest, dotted);
  if (node == nullptr || !node->is_string()) return std::nullopt;
  return node->get<std::string>();
}

std::string RunRecord::label() const {
  // Solvers of this project are acronyms; another code's name stays as its author writes it.
  std::string name = own ? in_capitals(solver) : solver;
  if (!walls.empty()) name += " " + walls;
  name += fmt::format(", l0 = {:g} m", l0_m);
  if (const auto a = alpha()) name += fmt::format(", alpha = {:g}", *a);
  return name;
}

std::vector<std::string> RunRecord::warnings() const {
  std::vector<std::string> texts;
  const auto found = manifest.find("warnings");
  if (found == manifest.end() || !found->is_array()) return texts;
  for (const nlohmann::json& warning : *found)
    if (warning.is_string()) texts.push_back(warning.get<std::string>());
  return texts;
}

std::vector<fs::path> RunRecord::snapshots() const {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path / "snapshots", ignored))
    if (entry.path().extension() == ".vtp") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

RunRecord read_run(const fs::path& directory) {
  if (!fs::is_directory(directory))
    throw std::runtime_error(
        fs::exists(directory)
            ? fmt::format("{}: is a file, not a run directory (write a map for it, see the README, and compare that)",
                          directory.string())
            : fmt::format("{}: no such run directory (give the --out of a run)", directory.string()));
  RunRecord run = parse_run(manifest_text(directory / "run.json"), directory);
  if (run.status() != "failed" || fs::exists(directory / "probes.csv"))
    run.probes = read_probes(directory / "probes.csv");
  return run;
}

bool has_rows(const fs::path& directory) {
  const fs::path file = directory / "probes.csv";
  if (!fs::is_regular_file(file)) return false;
  std::ifstream in(file);
  std::string header;
  return std::getline(in, header) && in.peek() != std::ifstream::traits_type::eof();
}

RunRecord parse_run(std::string_view manifest, const fs::path& directory) {
  RunRecord run;
  run.path = directory;
  const fs::path file = directory / "run.json";
  run.manifest = manifest_from(manifest, file);
  run.case_name = require(run.text("case"), file, "case", "\"kleefsman\"");
  run.solver = require(run.text("solver"), file, "solver", "\"name\"");
  run.l0_m = require(run.number("l0_m"), file, "l0_m", "0.02");
  if (!(run.l0_m > 0))
    throw std::runtime_error(
        fmt::format("{}: l0_m: is {}, must be greater than zero (metres)", file.string(), run.l0_m));
  run.walls = run.text("walls").value_or("");
  run.own = run.manifest.contains("schema");
  return run;
}

}  // namespace sluice
