// How much room a figure's panels need: for the axes, the words under them, and the legend.
#pragma once

#include "reports/plot.h"

namespace sluice {

/// Alike for all panels of a figure.
struct PanelRoom {
  int height_px = 0;
  int legend_columns = 1;
};

/// Legends stand below the panels, so that they never hide a curve: two columns where the longest entry lets them.
PanelRoom room_of(const PlotFigure& figure);

/// Whether the legend names a curve.
bool has_entry(const PlotCurve& curve);

}  // namespace sluice
