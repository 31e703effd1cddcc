#include "estimation/followed_shaft.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

void FollowedShaft::listenTo(const KeyphasorSettings& keyphasor) {
  tracker_.emplace(trackerOf(keyphasor, 0.0, 1.0e-6));
}

void FollowedShaft::restart() {
  if (tracker_) {
    tracker_->clear();
  }
  known_.reset();
  is_known_ = false;
}

ShaftEstimate FollowedShaft::at(std::int64_t instant, std::int64_t to_twin) {
  ShaftEstimate shaft = unknown(instant, to_twin);
  if (!tracker_) {
    shaft.known = true;
    shaft.deviation = 0.0;
    return shaft;
  }
  const ShaftEstimate told = tracker_->at(instant);
  if (told.known) {
    if (!is_known_) {
      untold_ = shaft.angle.turns - told.angle.turns +
                std::llround((shaft.angle.remainder - told.angle.remainder) / ShaftAngle::kTurn);
    }
    shaft = told;
    shaft.angle.turns += untold_;
    known_ = {instant, shaft.angle, shaft.speed};
  }
  is_known_ = told.known;
  return shaft;
}

ShaftEstimate FollowedShaft::unknown(std::int64_t instant, std::int64_t to_twin) {
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
