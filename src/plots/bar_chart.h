// Bars side by side from a base line, one group a name: what weighs most stands at the top where
// the groups come in that order (a tornado chart).
#pragma once

#include <string>
#include <vector>

#include "plots/canvas.h"
#include "plots/chart.h"

namespace whirl_twin {

/// From the base line to a value; one that is not finite is not drawn.
struct Bar {
  double value = 0.0;
  /// Ends of the interval that it is known within; not finite: none is drawn.
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
  double base = 0.0;               ///< where bars begin
};

/// The file. Throws RunFailure.
std::string barImage(const BarChart& chart, ImageFormat format);

}  // namespace whirl_twin
