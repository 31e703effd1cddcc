#include "estimation/estimator_shaft.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kSmall = 1.0e-3;  // of the duration, for finite differences

}  // namespace

ShaftPath::ShaftPath(const ShaftInstant& from, const ShaftInstant& to, std::int64_t to_twin)
    : from_(from),
      start_(static_cast<double>(from.time + to_twin) * kNanosecond),
      angle_(from.angle.remainder),
      turn_{static_cast<double>(to.time - from.time) * kNanosecond, 0.0,
            to.angle.remainder - from.angle.remainder +
                ShaftAngle::kTurn * static_cast<double>(to.angle.turns - from.angle.turns),
            from.speed, to.speed} {}

EvaluationPoint<double> ShaftPath::at(double part) const {
  const double t = part * duration();
  const double h = kSmall * duration();
  const double low = std::clamp(t, h, duration() - h);
  const double here = turn_.at(low), before = turn_.at(low - h), after = turn_.at(low + h);
  EvaluationPoint<double> moment;
  moment.time = start_ + t;
  moment.angle = angle_ + turn_.at(t);
  moment.acceleration = (after - 2.0 * here + before) / (h * h);
  moment.speed = (after - before) / (2.0 * h) + (t - low) * moment.acceleration;
  return moment;
}

ShaftInstant ShaftPath::instantAt(std::int64_t time) const {
  const double t = static_cast<double>(time - from_.time) * kNanosecond;
  const double h = std::min({kSmall * duration(), t, duration() - t});
  const double a = angle_ + turn_.at(t);
  const double whole = std::floor(a / ShaftAngle::kTurn);
  return {time,
          {from_.angle.turns + static_cast<std::int64_t>(whole), a - whole * ShaftAngle::kTurn},
          (turn_.at(t + h) - turn_.at(t - h)) / (2.0 * h)};
}

void EstimatorShaft::listenTo(const KeyphasorSettings& keyphasor) {
  tracker_.emplace(trackerOf(keyphasor, 0.0, 1.0e-6));
}

void EstimatorShaft::restart() {
  if (tracker_) {
    tracker_->clear();
  }
  known_.reset();
  is_known_ = false;
}

ShaftEstimate EstimatorShaft::at(std::int64_t instant, std::int64_t to_twin) {
  ShaftEstimate shaft = unknown(instant, to_twin);
  if (!tracker_) {
    shaft.known = true;
    shaft.deviation = 0.0;
    return shaft;
  }
  const ShaftEstimate estimate = tracker_->at(instant);
  if (estimate.known) {
    if (!is_known_) {
      extra_turns_ =
          shaft.angle.turns - estimate.angle.turns +
          std::llround((shaft.angle.remainder - estimate.angle.remainder) / ShaftAngle::kTurn);
    }
    shaft = estimate;
    shaft.angle.turns += extra_turns_;
    known_ = {instant, shaft.angle, shaft.speed};
  }
  is_known_ = estimate.known;
  return shaft;
}

ShaftEstimate EstimatorShaft::unknown(std::int64_t instant, std::int64_t to_twin) {
  constexpr double kHalfTurn = 0.5 * ShaftAngle::kTurn;
  if (known_) {
    const ShaftAngle angle = advance(known_->angle, known_->speed, instant - known_->time);
    return {false, angle, known_->speed, 0.0, kHalfTurn};
  }
  drive_.begin(instant + to_twin);
  const ShaftMotion motion = drive_.at(0.0);
  return {false, drive_.angle(), motion.speed, motion.acceleration, kHalfTurn};
}

}  // namespace whirl_twin
