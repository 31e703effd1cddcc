// Horizontal bar chart: bars from a base line, one group per name; with groups sorted by weight,
// largest on top, a tornado chart.
#pragma once

#include <string>
#include <vector>

#include "plots/canvas.h"
#include "plots/chart.h"

namespace whirl_twin {

/// From the base line to a value; one that is not finite is not drawn.
struct Bar {
  double value = 0.0;
  /// Ends of its confidence interval; not finite: not drawn.
  double low = 0.0, high = 0.0;
};

struct BarGroup {
  std::string name;
  std::vector<Bar> bars;  ///< one for each of BarChart::names
};

struct BarChart {
  std::string title;
  std::string subtitle;            ///< smaller, below it; "": none
  ChartAxis x;                     ///< linear
  std::vector<std::string> names;  ///< of the bars of a group, in the legend
  std::vector<BarGroup> groups;    ///< from the top down
  double base = 0.0;               ///< base line of the bars
};

/// The contents of the file. Throws RunFailure.
std::string barImage(const BarChart& chart, ImageFormat format);

}  // namespace whirl_twin
