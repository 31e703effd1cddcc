#include "display/whirl_scale.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {
namespace {

// Between an orbit far below any measurement and one a diverging rotor has left the room on.
constexpr double kLargestScale = 1e6;
constexpr double kSmallestScale = 1e-9;

}  // namespace

double roundDown125(double number) {
  const double decade = std::pow(10.0, std::floor(std::log10(number)));
  // 5 * 0.1 is not 0.5 to the last bit: a number of the series itself must not fall to the next.
  const double digit = number / decade * (1.0 + 1e-12);
  return (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0) * decade;
}

WhirlScale::WhirlScale(double fixed) : fixed_(fixed), value_(fixed > 0.0 ? fixed : kLargestScale) {}

void WhirlScale::observe(double radius, double time) {
  if (fixed_ > 0.0 || !std::isfinite(radius)) {
    return;
  }
  const double elapsed = time - time_;
  time_ = time;
  peak_ = elapsed < 0.0 ? radius : std::max(radius, peak_ * std::exp(-elapsed / kPeakDecayTime));
  const double drawn = peak_ * value_;
  if (drawn > kLargestRadius || (drawn < kSmallestRadius && peak_ > 0.0)) {
    value_ = std::clamp(roundDown125(kTargetRadius / peak_), kSmallestScale, kLargestScale);
  }
}

}  // namespace whirl_twin
