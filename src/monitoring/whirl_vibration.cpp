#include "monitoring/whirl_vibration.h"

#include <cstddef>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kLongestRevolution = 1.0;  // [s]
constexpr std::size_t kFewestOfOrbit = 32;  // samples, of several revolutions where they are rare

}  // namespace

double WhirlVibration::take(const state::WhirlState& whirl) {
  if (window_.empty() || whirl.at.time < window_.newest().time) {
    since_ = whirl.at.time;
  }
  window_.take({++taken_, whirl.at.time, 0, whirl.shaft_angle, whirl.speed, whirl.x, whirl.y});
  const double revolution = window_.since(1.0);
  if (revolution > 0.0 && revolution < kLongestRevolution) {
    return window_.amplitude(revolution, kFewestOfOrbit);
  }
  return whirl.at.time - since_ < kLongestRevolution
             ? kNaN
             : window_.amplitude(kLongestRevolution, kFewestOfOrbit);
}

}  // namespace whirl_twin
