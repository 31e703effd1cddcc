#include "control/actuator.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

Actuator::Actuator(const ActuatorSettings& settings, double period)
    : limit_(settings.limit > 0.0 ? settings.limit : kInfinity),
      most_(settings.slew > 0.0 ? settings.slew * period : kInfinity),
      resolution_(settings.resolution) {}

bool Actuator::take(double command) noexcept {
  const double wanted =
      resolution_ > 0.0 ? resolution_ * std::nearbyint(command / resolution_) : command;
  const double within = std::clamp(wanted, -limit_, limit_);
  const double change = within - value_;
  value_ += std::copysign(most_, change);
  if (std::fabs(change) <= most_ || std::fabs(within - value_) <= 1.0e-15 * std::fabs(within)) {
    value_ = within;  // the command itself, free of rounding
  }
  return value_ == wanted;
}

}  // namespace whirl_twin
