#include "reports/plot_room.h"

#include <algorithm>
#include <cmath>

#include "reports/text.h"

namespace sluice {
namespace {

constexpr int legend_row_px = 23;
constexpr int legend_gap_px = 14;
constexpr double slanted_character_px = 4.5;  // of height, at the slant of the script

/// The longest entries, in characters, of which gnuplot puts two beside each other (measured at 320 to 960 px).
std::size_t longest_in_two_columns(int panel_width_px) {
  return static_cast<std::size_t>(std::max(0.0, (panel_width_px - 124) / 18.4));
}

std::vector<std::string> entries_of(const PlotPanel& panel) {
  std::vector<std::string> entries;
  for (const PlotBand& band : panel.bands)
    if (!band.label.empty()) entries.push_back(band.label);
  for (const PlotCurve& curve : panel.curves)
    if (has_entry(curve) && !curve.label.empty()) entries.push_back(curve.label);
  return entries;
}

int slanted_words_px(const PlotPanel& panel) {
  std::size_t longest = 0;
  if (panel.slanted_ticks)
    for (const std::string& word : panel.x_ticks) longest = std::max(longest, characters(word));
  return static_cast<int>(std::lround(slanted_character_px * static_cast<double>(longest)));
}

}  // namespace

bool has_entry(const PlotCurve& curve) {
  return curve.look != CurveLook::guide && curve.look != CurveLook::leader;
}

PanelRoom room_of(const PlotFigure& figure) {
  std::size_t most_entries = 0;
  std::size_t longest = 0;
  int words_px = 0;
  for (const PlotPanel& panel : figure.panels) {
    const std::vector<std::string> entries = entries_of(panel);
    most_entries = std::max(most_entries, entries.size());
    for (const std::string& entry : entries) longest = std::max(longest, characters(entry));
    words_px = std::max(words_px, slanted_words_px(panel));
  }
  const int columns = longest > longest_in_two_columns(figure.panel_width_px) ? 1 : 2;
  const int rows = (static_cast<int>(most_entries) + columns - 1) / columns;
  return {figure.panel_height_px + words_px + legend_row_px * rows + legend_gap_px, columns};
}

}  // namespace sluice
