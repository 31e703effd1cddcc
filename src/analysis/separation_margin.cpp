#include "analysis/separation_margin.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {
namespace {

bool marginRequired(double amplification_factor) {
  return amplification_factor >= kCriticallyDampedAmplification;
}

double marginBelowUncapped(double amplification_factor) {
  return 17.0 * (1.0 - 1.0 / (amplification_factor - 1.5));
}

}  // namespace

double requiredMarginBelow(double amplification_factor) {
  if (!marginRequired(amplification_factor)) {
    return 0.0;
  }
  return std::min(16.0, marginBelowUncapped(amplification_factor));
}

double requiredMarginAbove(double amplification_factor) {
  if (!marginRequired(amplification_factor)) {
    return 0.0;
  }
  return std::min(26.0, 10.0 + marginBelowUncapped(amplification_factor));
}

double separationMargin(double running_speed, double critical_speed) {
  const double speed = std::abs(running_speed);
  if (speed == 0.0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return 100.0 * std::abs(speed - critical_speed) / speed;
}

double requiredSeparationMargin(double running_speed, double critical_speed,
                                double amplification_factor) {
  return std::abs(running_speed) < critical_speed ? requiredMarginAbove(amplification_factor)
                                                  : requiredMarginBelow(amplification_factor);
}

SpeedBand criticalBand(double critical_speed, double amplification_factor) {
  return {critical_speed / (1.0 + requiredMarginAbove(amplification_factor) / 100.0),
          critical_speed / (1.0 - requiredMarginBelow(amplification_factor) / 100.0)};
}

state::CriticalSpeedMargin criticalSpeedMargin(double running_speed, double critical_speed,
                                               const std::string& direction,
                                               double amplification_factor) {
  const SpeedBand band = criticalBand(critical_speed, amplification_factor);
  state::CriticalSpeedMargin margin;
  margin.speed = critical_speed;
  margin.direction = direction;
  margin.amplification_factor = amplification_factor;
  margin.separation_margin = separationMargin(running_speed, critical_speed);
  margin.required_separation_margin =
      requiredSeparationMargin(running_speed, critical_speed, amplification_factor);
  margin.band_low = band.from;
  margin.band_high = band.to;
  return margin;
}

}  // namespace whirl_twin
