// An axis of a chart: its ends, its marks, and where a value stands along it.
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

  /// From 0 at the low end to 1; not finite where the axis has no such place.
  double place(double value) const;
  /// Sets at most `most` ticks, and the ends at the outer ones unless it is tight.
  void mark(bool tight, int most);
};

/// One unit is as long along the one as along the other, these many pixels: the longer range is
/// that of both. Their ticks, at most so many on each, are equally far apart and have one exponent.
void markEqually(MarkedAxis& a, double a_pixels, MarkedAxis& b, double b_pixels, int most);

/// From the smallest to the largest value that an axis can show (kLargestOnAxis; on a logarithmic
/// one positive ones), with a length.
AxisRange dataRange(const std::vector<const std::vector<double>*>& values, bool logarithmic);

}  // namespace whirl_twin
