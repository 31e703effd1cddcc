#include "plots/marked_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {

namespace {

bool shown(double value, bool logarithmic) {
  return std::fabs(value) <= kLargestOnAxis && (!logarithmic || value >= 1.0 / kLargestOnAxis);
}

}  // namespace

double MarkedAxis::place(double value) const {
  if (!shown(value, logarithmic)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (logarithmic) {
    return std::log(value / range.low) / std::log(range.high / range.low);
  }
  return (value - range.low) / (range.high - range.low);
}

void MarkedAxis::mark(bool tight, int most) {
  ticks = logarithmic ? logarithmicTicks(range, most) : linearTicks(range, most);
  labels = logarithmic ? logarithmicLabels(ticks) : linearLabels(ticks);
  if (!tight) {
    range = {ticks.front(), ticks.back()};
  }
}

AxisRange dataRange(const std::vector<const std::vector<double>*>& values, bool logarithmic) {
  AxisRange range{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  for (const std::vector<double>* series : values) {
    for (const double value : *series) {
      if (shown(value, logarithmic)) {
        range = {std::min(range.low, value), std::max(range.high, value)};
      }
    }
  }
  if (range.low > range.high) {  // no data
    return logarithmic ? AxisRange{1.0, 10.0} : AxisRange{0.0, 1.0};
  }
  return logarithmic ? AxisRange{range.low, std::max(range.high, 1.001 * range.low)}
                     : widened(range);
}

}  // namespace whirl_twin
