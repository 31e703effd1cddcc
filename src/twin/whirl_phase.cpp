#include "twin/whirl_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;
/// A radius below this part of the largest so far has no angle worth the name.
constexpr double kSmallestRadius = 1.0e-9;

}  // namespace

double WhirlMotion::radius() const {
  return std::hypot(x, y);
}

void WhirlPhase::observe(const WhirlMotion& whirl, double mark) {
  const double radius = whirl.radius();
  largest_radius_ = std::max(largest_radius_, radius);
  valid_ = radius > kSmallestRadius * largest_radius_;
  if (!valid_) {
    return;
  }
  const double lag = mark - std::atan2(whirl.y, whirl.x);
  const double reference = known_ ? lag_ : 0.0;
  // Whole turns, so that the last bit does not depend on which records were seen before.
  lag_ = lag + 2.0 * kPi * std::nearbyint((reference - lag) / (2.0 * kPi));
  known_ = true;
}

double WhirlPhase::lag() const {
  return valid_ ? lag_ : std::numeric_limits<double>::quiet_NaN();
}

double WhirlPhase::quietFor(const WhirlMotion& whirl, double speed, double fastest) const {
  if (!valid_) {
    return 0.0;
  }
  const double radius = whirl.radius();
  const double velocity = std::hypot(whirl.x_rate, whirl.y_rate);
  const double of_speed = 0.5 * radius / velocity;
  const double of_acceleration = std::sqrt(0.5 * radius / largest_radius_) / fastest;
  const double of_mark = 0.5 * kPi / std::fabs(speed);
  return std::min({of_speed, of_acceleration, of_mark});
}

}  // namespace whirl_twin
