#include "display/scales.h"

#include <algorithm>
#include <cmath>

#include "mechanics/round_number.h"

namespace whirl_twin {

namespace {

// From an orbit far below any measurement to that of a diverging rotor.
constexpr double kMaxScale = 1e6;
constexpr double kSmallestScale = 1e-9;

}  // namespace

WhirlScale::WhirlScale(double fixed, double room)
    : fixed_(fixed), room_(room), value_(fixed > 0.0 ? fixed : kMaxScale) {}

void WhirlScale::observe(double radius, double time) {
  if (fixed_ > 0.0 || !std::isfinite(radius)) {
    return;
  }
  const double elapsed = time - time_;
  time_ = time;
  peak_ = elapsed < 0.0 ? radius : std::max(radius, peak_ * std::exp(-elapsed / kPeakDecayTime));
  const double drawn = peak_ * value_ / room_;
  if (drawn > kMaxRadius || (drawn < kMinRadius && peak_ > 0.0)) {
    value_ = std::clamp(roundDown125(room_ * kTargetRadius / peak_), kSmallestScale, kMaxScale);
  }
}

}  // namespace whirl_twin
