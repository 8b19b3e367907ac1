#include "ci/dashboard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "ci/page.h"
#include "ci/summary.h"
#include "validation/manifest.h"

namespace sluice::ci {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Where a click on a run leads: to a web address as it is, to a directory on this disk by a relative path, else
/// nowhere.
std::string href_of(const std::string& link, const fs::path& page_directory) {
  if (link.starts_with("https://") || link.starts_with("http://")) return link;
  std::error_code error;
  if (link.empty() || !fs::exists(link, error)) return "";
  const fs::path path = fs::proximate(fs::absolute(link), fs::absolute(page_directory), error);
  return error ? "" : path.generic_string();
}

/// Runs, each once: the points of all series refer to them by number.
class Runs {
 public:
  explicit Runs(fs::path page_directory) : page_directory_(std::move(page_directory)) {}

  std::size_t number(const Result& r) {
    const auto [at, is_new] = numbers_.try_emplace({r.run, r.date, r.threads}, list_.size());
    if (is_new)
      list_.push_back({{"run", r.run},
                       {"date", r.date},
                       {"commit", r.commit},
                       {"machine", r.machine},
                       {"threads", r.threads},
                       {"compiler", r.compiler},
                       {"flags", r.flags},
                       {"link", r.link},
                       {"href", href_of(r.link, page_directory_)}});
    return at->second;
  }
  json take() { return std::move(list_); }

 private:
  fs::path page_directory_;
  std::map<std::tuple<std::string, std::string, int>, std::size_t> numbers_;
  json list_ = json::array();
};

/// How the page writes values: as value_text() does.
std::string form_of(const MetricSeries& series) {
  if (series.kind().family == Family::cost || series.key.metric == "finished") return "plain";
  if (series.kind().better == Better::unchanged) return "plain";
  if (series.unit == "1") return "percent";
  return series.unit == "s" ? "milliseconds" : "plain";
}

/// Findings count values; the page counts points, those without a value included.
std::size_t point_of(const SeriesFindings& found, const Result* result) {
  const auto& points = found.series.points;
  return static_cast<std::size_t>(std::find(points.begin(), points.end(), result) - points.begin());
}

json findings_of(const SeriesFindings& found) {
  json list = json::array();
  for (const Finding& finding : found.findings) {
    const Shift& shift = finding.shift;
    json entry = {{"first", point_of(found, finding.first)},
                  {"verdict", to_string(finding.verdict)},
                  {"state", to_string(finding.state)},
                  {"before", shift.before},
                  {"detail", detail_text(found, finding)}};
    if (finding.verdict != Verdict::missing) entry["after"] = shift.after;
    list.push_back(std::move(entry));
  }
  return list;
}

json points_of(const SeriesFindings& found, Runs& runs) {
  json list = json::array();
  for (const Result* point : found.series.points) {
    if (point->value)
      list.push_back({runs.number(*point), *point->value});
    else
      list.push_back({runs.number(*point), nullptr, point->reason});
  }
  return list;
}

json series_entry(const SeriesFindings& found, Runs& runs) {
  const MetricSeries& series = found.series;
  const MetricKind& kind = series.kind();
  return {{"id", series.key.id()},
          {"case", series.key.case_name},
          {"solver", series.key.solver},
          {"kind", series.key.run_kind()},
          {"metric", series.key.metric},
          {"quantity", series.key.quantity()},
          {"unit", series.unit},
          {"machine", series.key.machine},
          {"family", to_string(kind.family)},
          {"better", to_string(kind.better)},
          {"alarms", kind.alarms},
          {"meaning", kind.meaning},
          {"form", form_of(series)},
          {"stale", found.stale},
          {"points", points_of(found, runs)},
          {"findings", findings_of(found)}};
}

/// What is open first, benchmarks last; the series of one kind of run together, in the order of metric_kinds().
auto page_order(const SeriesFindings& found) {
  const bool open = std::any_of(found.findings.begin(), found.findings.end(),
                                [](const Finding& finding) { return finding.state == State::open; });
  const MetricSeries& series = found.series;
  return std::tuple(!open, series.key.case_name == benchmark_case, series.key.run_kind(), order_of(series.key.metric),
                    series.key.quantity(), series.key.machine);
}

json page_data(const Ledger& ledger, const std::vector<SeriesFindings>& all, const fs::path& directory) {
  std::vector<const SeriesFindings*> ordered;
  for (const SeriesFindings& found : all) ordered.push_back(&found);
  std::sort(ordered.begin(), ordered.end(),
            [](const SeriesFindings* a, const SeriesFindings* b) { return page_order(*a) < page_order(*b); });
  Runs runs(directory);
  json series = json::array();
  for (const SeriesFindings* found : ordered) series.push_back(series_entry(*found, runs));
  json damaged = json::array();
  for (const DamagedLine& line : ledger.damaged) damaged.push_back({line.line, line.problem});
  json data = {{"made", utc_now()}, {"series", std::move(series)}, {"damaged", std::move(damaged)}};
  data["runs"] = runs.take();
  return data;
}

/// JSON that can stand inside a script element: nothing in it can end the element.
std::string script_text(const json& data) {
  std::string text = data.dump(-1, ' ', false, json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

void put(std::string& page, std::string_view mark, std::string_view text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::runtime_error(fmt::format("ci/page/page.html has no {}", mark));
  page.replace(at, mark.size(), text);
}

}  // namespace

std::string dashboard_page(const Ledger& ledger, const std::vector<SeriesFindings>& all, const fs::path& directory) {
  std::string page(page_html);
  put(page, "/*STYLE*/", page_style);
  put(page, "/*SCRIPT*/", page_script);
  put(page, "/*DATA*/", script_text(page_data(ledger, all, directory)));
  return page;
}

void write_dashboard(const fs::path& file, const Ledger& ledger, const std::vector<SeriesFindings>& all) {
  std::error_code ignored;
  const fs::path directory = file.has_parent_path() ? file.parent_path() : fs::path(".");
  fs::create_directories(directory, ignored);
  const fs::path half = file.string() + ".tmp";
  std::ofstream out(half, std::ios::binary | std::ios::trunc);
  out << dashboard_page(ledger, all, directory);
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written: {}", half.string(), std::strerror(errno)));
  std::error_code error;
  fs::rename(half, file, error);
  if (error) throw std::runtime_error(fmt::format("{}: cannot be replaced: {}", file.string(), error.message()));
}

}  // namespace sluice::ci
