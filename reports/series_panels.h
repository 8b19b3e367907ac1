// Panels of what a sensor saw over time, with the experiment behind the runs: what the figures of series have in
// common.
#pragma once

#include <string>
#include <vector>

#include "reports/figures.h"
#include "reports/plot.h"

namespace sluice {

/// Width of the running mean in long views of what has spikes   [s]
inline constexpr double smoothing_s = 0.01;

/// Which runs leave a panel through its top, in words for the caption.
struct Cut {
  double limit = 0;
  std::string unit;
  std::string words;
};

/// What of a sensor is drawn.
struct View {
  std::string model;  ///< empty: the primary reading
  Window window;
  bool smoothed = false;
};

/// Panels of one sensor, one a group of runs; empty when no run has the reading. `cut` collects what leaves the panel.
std::vector<PlotPanel> sensor_panels(const ReportData& data, const CaseSensor& sensor, const View& view, Cut& cut);

/// Panels of one sensor that hold several methods or codes, one a group, each curve with the model that read it; groups
/// in which less than two of them have this sensor are left out.
std::vector<PlotPanel> shared_panels(const ReportData& data, const std::vector<RunGroup>& groups,
                                     const CaseSensor& sensor, const View& view, Cut& cut);

/// The measured mean and band over a window, where there are any.
void add_experiment(PlotPanel& panel, const ReportData& data, const CaseSensor& sensor, Window window);

/// "pressure at P1 [kPa]"
std::string axis_name(const CaseSensor& sensor);

/// A caption with what the reader must know of the measurement.
std::string with_remark(const ReportData& data, const CaseSensor& sensor, const std::string& caption);

/// Draws panels of all runs.
Picture draw_series(const FigureMaker& maker, const std::string& name, std::vector<PlotPanel> panels,
                    const std::string& caption, const std::string& description);

}  // namespace sluice
