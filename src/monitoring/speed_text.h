// A speed of a shaft in the text of an alert: rad/s, as in every message, and rpm for the operator.
#pragma once

#include <fmt/format.h>

#include <string>

#include "algebra/constants.h"

namespace whirl_twin {

inline std::string shaftSpeedText(double speed) {
  return fmt::format("{:.1f} rad/s ({:.0f} rpm)", speed, speed * 30.0 / kPi);
}

}  // namespace whirl_twin
