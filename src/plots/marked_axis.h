// An axis of a chart: its ends, its ticks, and the position of a value along it.
#pragma once

#include <vector>

#include "plots/ticks.h"

namespace whirl_twin {

struct MarkedAxis {
  AxisRange range;
  bool logarithmic = false;
  std::vector<double> ticks;
  TickLabels labels;
  bool degrees = false;

  /// From 0 at the low end to 1; not finite where the axis has no such position.
  double place(double value) const;
  /// Sets at most `most` ticks, and the ends at the outer ones unless it is tight.
  void mark(bool tight, int most);
};

/// Equal scales of two axes of these lengths in pixels: the longer range is used for both. Their
/// ticks, at most `most` on each, have the same spacing and one exponent.
void markEqually(MarkedAxis& a, double a_pixels, MarkedAxis& b, double b_pixels, int most);

/// From the smallest to the largest value within the range of an axis (kMaxOnAxis; on a
/// logarithmic one positive values), with nonzero length.
AxisRange dataRange(const std::vector<const std::vector<double>*>& values, bool logarithmic);

}  // namespace whirl_twin
