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
  valid_ = radius > kMinRadius * largest_radius_;
  if (!valid_) {
    return;
  }
  const double lag = mark.direction() - std::atan2(whirl.y, whirl.x);
  // Whole turns, so that the last bit does not depend on the observed records.
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

void WhirlPhaseTracker::put(const std::vector<Station>& stations) {
  places_.resize(stations.size());
  for (std::size_t k = 0; k < stations.size(); ++k) {
    Place& place = places_[k];
    place.at = stations[k];
    place.across.clear();
    for (Eigen::Index j = 0; j < place.at.along_x.size(); ++j) {
      place.across.push_back(place.at.along_x[j]);
      place.across.push_back(place.at.along_y[j]);
    }
  }
}

WhirlMotion WhirlPhaseTracker::motion(std::size_t k, const double* q, const double* v) const {
  const Station& at = places_[k].at;
  const Eigen::Map<const Eigen::VectorXd> places(q, at.along_x.size());
  const Eigen::Map<const Eigen::VectorXd> rates(v, at.along_x.size());
  return {at.along_x.dot(places), at.along_y.dot(places), at.along_x.dot(rates),
          at.along_y.dot(rates)};
}

void WhirlPhaseTracker::settle(std::int64_t step, const ShaftView& shaft, double on_shaft,
                               double seconds) {
  for (Place& place : places_) {
    ShaftMark then{shaft.angle(), on_shaft};
    if (place.seen != step) {
      const SplitTime back{-static_cast<double>(step - place.seen) * seconds, 0.0};
      then.shaft = advance(then.shaft, shaft.speed(), shaft.acceleration(), shaft.jerk(), back);
    }
    place.phase.settle(then);
  }
}

void WhirlPhaseTracker::observe(std::int64_t step, const double* q, const double* v,
                                const ShaftMark& mark) {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    places_[k].phase.observe(motion(k, q, v), mark);
    places_[k].seen = step;
  }
}

bool WhirlPhaseTracker::follow(std::int64_t step, const double* q) noexcept {
  for (Place& place : places_) {
    double x = 0.0;
    double y = 0.0;
    const double* across = place.across.data();
    for (std::size_t j = 0, n = place.across.size(); j < n; j += 2) {
      const double qj = *q++;
      x += across[j] * qj;
      y += across[j + 1] * qj;
    }
    q -= place.across.size() / 2;
    if (!place.phase.follow(x, y)) {
      return false;
    }
    place.seen = step;
  }
  return true;
}

}  // namespace whirl_twin
