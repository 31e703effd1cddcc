#include "reports/history_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"

namespace whirl_twin {

Chart historyChart(const PlotHistory& history, const std::string& name, const std::string& unit,
                   const std::vector<double>& values) {
  Chart chart;
  chart.x = {"time (s)", false, true};
  chart.y.label = fmt::format("{} ({})", name, unit);
  chart.series.push_back({name, history.time, values});
  return chart;
}

Chart speedChart(const PlotHistory& history, const std::string& name,
                 const std::vector<double>& values) {
  Chart chart = historyChart(history, name, "rad/s", values);
  chart.y.second = SecondScale{"rpm", 1.0 / kRpm};
  return chart;
}

double spread(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return low < high ? high - low : 0.0;
}

}  // namespace whirl_twin
