#include "twin/whirl_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"

namespace whirl_twin {

double WhirlMotion::radius() const {
  return std::hypot(x, y);
}

void WhirlPhase::observe(const WhirlMotion& whirl, const ShaftMark& mark) {
  const double radius = whirl.radius();
  if (largest_square_ > largest_radius_ * largest_radius_) {
    largest_radius_ = std::sqrt(largest_square_);
  }
  largest_radius_ = std::max(largest_radius_, radius);
  largest_square_ = largest_radius_ * largest_radius_;
  valid_ = radius > kSmallestRadius * largest_radius_;
  if (!valid_) {
    return;
  }
  const double lag = mark.direction() - std::atan2(whirl.y, whirl.x);
  // Whole turns, so that the last bit does not depend on which records were seen before.
  turns_ = std::nearbyint((lag_ - lag) / (2.0 * kPi));
  lag_ = lag + 2.0 * kPi * turns_;
  mark_ = mark;
  x_ = whirl.x;
  y_ = whirl.y;
  around_ = 0;
}

void WhirlPhase::settle(const ShaftMark& mark) {
  if (!followed_) {
    return;
  }
  followed_ = false;
  turns_ += static_cast<double>(mark.shaft.turns - mark_.shaft.turns - around_);
  lag_ = mark.direction() - std::atan2(y_, x_) + 2.0 * kPi * turns_;
  mark_ = mark;
  around_ = 0;
}

double WhirlPhase::lag() const {
  return valid_ ? lag_ : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace whirl_twin
