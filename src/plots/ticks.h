// Positions of ticks: at multiples of 1, 2 or 5 times a power of ten, so that every label is a
// short number.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

/// The ends of an axis, in its unit.
struct AxisRange {
  double low = 0.0, high = 1.0;
};

/// Maximum of an axis, and reciprocal of the smallest positive number: beyond it lengths of axes
/// and powers of ten leave the range of double.
inline constexpr double kMaxOnAxis = 1.0e300;

/// Widens a single value by a tenth of it to either side, so that an axis has a length and short
/// labels. The ends are within kMaxOnAxis.
AxisRange widened(AxisRange range);

/// Ticks that cover the range: the first is not above its low end, the last not below its high end,
/// and there are at most `most` (>= 3) of them. The range has a length (see widened()).
std::vector<double> linearTicks(const AxisRange& range, int most);

/// The same for degrees: over a wide range a half, a quarter, an eighth of a turn apart, or 30 or
/// 15.
std::vector<double> degreeTicks(const AxisRange& range, int most);

/// Ticks that cover a positive range: the powers of ten, with 2 and 5 times them between where the
/// range is short, and only some of them where it is long.
std::vector<double> logarithmicTicks(const AxisRange& range, int most);

/// The labels of the ticks: label x 10^exponent.
struct TickLabels {
  std::vector<std::string> text;
  int exponent = 0;  ///< a multiple of 3
};
TickLabels linearLabels(const std::vector<double>& ticks);
/// With a given exponent.
TickLabels linearLabels(const std::vector<double>& ticks, int exponent);
TickLabels logarithmicLabels(const std::vector<double>& ticks);

/// "10" with a superscript: UTF-8.
std::string powerOfTen(int exponent);

}  // namespace whirl_twin
