#include "reports/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "reports/document.h"
#include "reports/sections.h"
#include "validation/manifest.h"

namespace sluice {

namespace {

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out)
    throw std::runtime_error(
        fmt::format("{}: cannot write the report (remedy: check permissions and space on the disk)", file.string()));
}

void write_tables(const ReportDocument& document, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const ReportSection& section : document.sections)
    for (const Block& block : section.blocks)
      if (const Table* table = std::get_if<Table>(&block)) {
        write_file(folder / (table->name + ".csv"), to_csv(*table));
        write_file(folder / (table->name + ".tex"), to_latex(*table));
      }
}

/// Tables and figures that the report before this one linked to: what this one does not make again must not stay beside
/// it. Files of another origin are left alone.
void remove_last_report(const std::filesystem::path& out) {
  std::ifstream in(out / "report.md");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::error_code ignored;
  for (const char* folder : {"](tables/", "](figures/"}) {
    for (std::size_t at = page.find(folder); at != std::string::npos; at = page.find(folder, at + 1)) {
      const std::size_t begin = at + 2;
      const std::string file = page.substr(begin, page.find(')', begin) - begin);
      if (file.find("..") == std::string::npos) std::filesystem::remove(out / file, ignored);
    }
  }
}

std::string subtitle(const ReportData& data) {
  const Case& c = data.the_case;
  const bool measured = std::any_of(c.sensors.begin(), c.sensors.end(),
                                    [&](const CaseSensor& s) { return data.measured_series(s.name) != nullptr; });
  const bool published = !c.published.impulses.empty() || !c.published.runs.empty();
  std::string against = measured ? " against the experiment" : "";
  if (published) against += against.empty() ? " against the published values" : " and the published values";
  return fmt::format("{} {}{}. {}", data.runs.size(), data.runs.size() == 1 ? "simulation" : "simulations", against,
                     c.reference);
}

}  // namespace

void write_report(const std::vector<std::filesystem::path>& run_directories, const std::filesystem::path& out,
                  const ReportOptions& options) {
  write_analysed(analyse(run_directories), out, options);
}

void write_analysed(const ReportData& data, const std::filesystem::path& out, const ReportOptions& options) {
  std::filesystem::create_directories(out);
  remove_last_report(out);
  const FigureMaker maker{data, out, options.figures};
  ReportDocument document;
  document.title = options.title.empty() ? data.the_case.title : options.title;
  document.subtitle = subtitle(data);
  document.made = fmt::format("Made {} by sluice {} ({}).", utc_now(), build_info().version, build_info().commit);
  document.key_numbers = key_numbers(data);
  document.sections = report_sections(maker, options.snapshots);
  write_tables(document, out / "tables");
  write_file(out / "report.md", to_markdown(document));
  write_file(out / "index.html", to_html(document, out));
}

}  // namespace sluice
