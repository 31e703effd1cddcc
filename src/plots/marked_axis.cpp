#include "plots/marked_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {

namespace {

bool canBeShown(double value, bool logarithmic) {
  return std::fabs(value) <= kMaxOnAxis && (!logarithmic || value >= 1.0 / kMaxOnAxis);
}

}  // namespace

double MarkedAxis::place(double value) const {
  if (!canBeShown(value, logarithmic)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (logarithmic) {
    return std::log(value / range.low) / std::log(range.high / range.low);
  }
  return (value - range.low) / (range.high - range.low);
}

void MarkedAxis::mark(bool tight, int most) {
  ticks = logarithmic ? logarithmicTicks(range, most)
          : degrees   ? degreeTicks(range, most)
                      : linearTicks(range, most);
  labels = logarithmic ? logarithmicLabels(ticks) : linearLabels(ticks);
  if (!tight) {
    range = {ticks.front(), ticks.back()};
  }
}

void markEqually(MarkedAxis& a, double a_pixels, MarkedAxis& b, double b_pixels, int most) {
  constexpr int kFewest = 3;
  const double unit =
      std::max((a.range.high - a.range.low) / a_pixels, (b.range.high - b.range.low) / b_pixels);
  const auto stretch = [&](MarkedAxis& axis, double pixels) {
    const double middle = 0.5 * (axis.range.low + axis.range.high);
    axis.range = {middle - 0.5 * unit * pixels, middle + 0.5 * unit * pixels};
    axis.mark(true, most);
  };
  stretch(a, a_pixels);
  stretch(b, b_pixels);
  const auto step = [](const MarkedAxis& axis) { return axis.ticks[1] - axis.ticks[0]; };
  MarkedAxis& finer = step(a) < step(b) ? a : b;
  const double wide = (1.0 - 1.0e-6) * std::max(step(a), step(b));
  for (int fewer = most - 1; step(finer) < wide && fewer >= kFewest; --fewer) {
    finer.mark(true, fewer);
  }
  const int exponent = std::max(a.labels.exponent, b.labels.exponent);
  a.labels = linearLabels(a.ticks, exponent);
  b.labels = linearLabels(b.ticks, exponent);
}

AxisRange dataRange(const std::vector<const std::vector<double>*>& values, bool logarithmic) {
  AxisRange range{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  for (const std::vector<double>* series : values) {
    for (const double value : *series) {
      if (canBeShown(value, logarithmic)) {
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
