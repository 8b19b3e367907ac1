#include "validation/series.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "validation/printable.h"
#include "validation/text_table.h"

namespace sluice {

ColumnName split_column_name(std::string_view header) {
  // The one unit that has an underscore itself.
  constexpr std::string_view metres_per_second = "_m_s";
  const auto at = header.ends_with(metres_per_second) ? header.size() - metres_per_second.size() : header.rfind('_');
  if (at == std::string_view::npos) return {std::string(header), ""};
  return {std::string(header.substr(0, at)), std::string(header.substr(at + 1))};
}

ProbeTable::ProbeTable(std::filesystem::path path, std::vector<std::string> names, std::vector<double> t_s,
                       std::vector<std::vector<double>> columns)
    : path_(std::move(path)), names_(std::move(names)), t_s_(std::move(t_s)), columns_(std::move(columns)) {
  if (names_.size() != columns_.size()) {
    throw std::invalid_argument(fmt::format("{} column names for {} columns", names_.size(), columns_.size()));
  }
  for (std::size_t k = 0; k < names_.size(); ++k) {
    if (columns_[k].size() != t_s_.size()) {
      throw std::invalid_argument(
          fmt::format("column {} has {} values for {} times", names_[k], columns_[k].size(), t_s_.size()));
    }
    if (!index_.emplace(names_[k], k).second) {
      throw std::invalid_argument(fmt::format("column {} occurs twice", names_[k]));
    }
  }
}

bool ProbeTable::has(std::string_view full_name) const {
  return index_.contains(full_name);
}

const std::vector<double>& ProbeTable::values(std::string_view full_name) const {
  const auto at = index_.find(full_name);
  if (at == index_.end()) {
    throw std::out_of_range(fmt::format("{}: no column {}; there are: {}", path_.string(), full_name,
                                        names_.empty() ? "none" : fmt::format("{}", fmt::join(names_, ", "))));
  }
  return columns_[at->second];
}

Series ProbeTable::column(std::string_view full_name) const {
  auto [name, unit] = split_column_name(full_name);
  return {std::move(name), std::move(unit), t_s_, values(full_name)};
}

namespace {

std::vector<std::string> read_probe_header(TextTableReader& reader) {
  auto header = split_fields(reader.next_header_line(), ',');
  if (header.empty() || header[0] != "t_s") {
    reader.fail(fmt::format("the first column must be t_s, the time in seconds; rename or convert \"{}\"",
                            header.empty() ? "" : printable(header[0])));
  }
  std::map<std::string, int> seen;
  for (std::size_t k = 0; k < header.size(); ++k) {
    if (header[k].empty()) reader.fail(fmt::format("column {} has no name; write <sensor>_<unit>", k + 1));
    if (printable(header[k], header[k].size()) != header[k])
      reader.fail(fmt::format("the name of column {} holds a control character; rename it", k + 1));
    if (++seen[header[k]] > 1) reader.fail(fmt::format("column {} occurs twice; rename or delete one", header[k]));
  }
  return header;
}

ProbeTable read_table(TextTableReader& reader, const std::filesystem::path& path) {
  auto header = read_probe_header(reader);
  auto columns = reader.read_rows(header, ',', 0);
  auto times = std::move(columns.front());
  header.erase(header.begin());
  columns.erase(columns.begin());
  return {path, std::move(header), std::move(times), std::move(columns)};
}

}  // namespace

ProbeTable read_probes(const std::filesystem::path& path) {
  TextTableReader reader(path);
  return read_table(reader, path);
}

ProbeTable parse_probes(std::string_view text, const std::filesystem::path& path) {
  TextTableReader reader(path, text);
  return read_table(reader, path);
}

void write_probes(const std::filesystem::path& path, const ProbeTable& table) {
  ProbeWriter writer(path, table.names());
  std::vector<const std::vector<double>*> columns;
  for (const auto& name : table.names()) columns.push_back(&table.values(name));
  std::vector<double> row(columns.size());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) row[k] = (*columns[k])[i];
    writer.append(table.times_s()[i], row);
  }
  writer.close();
}

}  // namespace sluice
