#include "twin/followed_whirl.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

/// Steps, after which a steady whirl is looked at again: rounding adds up.
constexpr std::int64_t kLongestRest = 4096;
/// Steps, below which finding out is not worth it.
constexpr std::int64_t kShortestRest = 64;
/// Steps within which speeds are bounded to put off a look, and looks from one step after another
/// after it was not worth it.
constexpr std::int64_t kMostPutOff = 16;
constexpr int kLooksInTurn = 32;
/// Part of the largest radius, below which a whirl soon has no angle.
constexpr double kSmall = 1.0e-6;

}  // namespace

void FollowedWhirl::put(const std::vector<Station>& stations) {
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
  rest_.reset();
  rest_sought_ = false;
  looks_in_turn_ = 0;
  steady_.reset();
  sought_ = std::numeric_limits<double>::quiet_NaN();
}

std::vector<Station> FollowedWhirl::stations() const {
  std::vector<Station> all;
  for (const Place& place : places_) {
    all.push_back(place.at);
  }
  return all;
}

WhirlMotion FollowedWhirl::motion(std::size_t k, const double* q, const double* v) const {
  const Station& at = places_[k].at;
  const Eigen::Map<const Eigen::VectorXd> places(q, at.along_x.size());
  const Eigen::Map<const Eigen::VectorXd> rates(v, at.along_x.size());
  return {at.along_x.dot(places), at.along_y.dot(places), at.along_x.dot(rates),
          at.along_y.dot(rates)};
}

void FollowedWhirl::settle(std::int64_t step, const ShaftView& shaft, double on_shaft,
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

void FollowedWhirl::observe(std::int64_t step, const double* q, const double* v,
                            const ShaftMark& mark) {
  const bool steady = steady_ && step <= steady_until_;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    // While looks are put off a whirl goes round by less than half a turn, however its shaft turns.
    const bool put_off = step <= next_look_ && step - places_[k].seen > 1;
    const Kept otherwise = put_off ? Kept::kDirection : Kept::kLag;
    places_[k].phase.observe(motion(k, q, v), mark, steady ? steady_->keeps(k) : otherwise);
    places_[k].seen = step;
  }
  told_ = step;
  next_look_ = step + 1;
  steady_until_ = std::max(steady_until_, step);
}

bool FollowedWhirl::follow(std::int64_t step, const double* q) noexcept {
  if (step <= steady_until_ || step > next_look_) {
    return step < steady_until_;
  }
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
  next_look_ = step + 1;
  return true;
}

void FollowedWhirl::putOff(const Dynamics& dynamics, const double* q, const double* v,
                           const Drive& drive, double seconds) {
  if (looks_in_turn_ > 0) {
    --looks_in_turn_;
    return;
  }
  if (!rest_sought_) {
    rest_sought_ = true;
    rest_ = WhirlRest::of(dynamics, stations());
  }
  const bool wide = std::all_of(places_.begin(), places_.end(),
                                [](const Place& place) { return place.phase.isWide(kSmall); });
  std::int64_t steps = 0;
  if (rest_ && wide) {
    const ShaftMotion shaft = drive.withoutAngle(0.0);
    const double longest = std::min(drive.nextCorner(0.0), kMostPutOff * seconds);
    const ShaftMotion end = drive.withoutAngle(longest);
    const double acceleration =
        std::max(std::fabs(shaft.acceleration), std::fabs(end.acceleration));
    // Between the two ends it is no further from them than a vertex of the parabola can be.
    const double speed = std::max(std::fabs(shaft.speed), std::fabs(end.speed)) +
                         0.125 * longest * longest * std::fabs(shaft.jerk);
    steps = static_cast<std::int64_t>(rest_->lasts(q, v, speed, acceleration, seconds, longest) /
                                      seconds);
  }
  if (steps > 1) {
    next_look_ += steps - 1;
  } else {
    looks_in_turn_ = kLooksInTurn;
  }
}

void FollowedWhirl::findSteady(const Dynamics& dynamics, const double* q, const double* v,
                               const ShaftView& shaft, double seconds, std::int64_t steps,
                               bool coarse) {
  if (told_ < steady_until_ || steps < kShortestRest) {
    return;
  }
  if (sought_ != shaft.speed()) {
    sought_ = shaft.speed();
    steady_ = SteadyWhirl::of(dynamics, stations(), sought_);
  }
  if (!steady_) {
    return;
  }
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const WhirlPhase& phase = places_[k].phase;
    if (!phase.valid() || steady_->leastRadius(k) < kSmall * phase.largestRadius() ||
        (coarse && steady_->keeps(k) == Kept::kDirection)) {
      return;
    }
  }
  const double lasts = steady_->lasts(q, v, shaft.remainder()) / seconds;
  const double longest = static_cast<double>(std::min(steps, kLongestRest));
  steady_until_ = told_ + static_cast<std::int64_t>(std::min(lasts, longest));
}

}  // namespace whirl_twin
