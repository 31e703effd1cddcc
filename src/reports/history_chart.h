// A chart over time of one quantity of a run.
#pragma once

#include <string>
#include <vector>

#include "plots/chart.h"
#include "reports/plot_history.h"

namespace whirl_twin {

/// "name (unit)" over the time of the history; a value for each of its samples.
Chart historyChart(const PlotHistory& history, const std::string& name, const std::string& unit,
                   const std::vector<double>& values);
/// Of a speed [rad/s], with rpm on the right.
Chart speedChart(const PlotHistory& history, const std::string& name,
                 const std::vector<double>& values);

/// Largest less smallest of the finite values.
double spread(const std::vector<double>& values);

}  // namespace whirl_twin
