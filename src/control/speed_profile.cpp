#include "control/speed_profile.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {
namespace {

void appendSegment(SpeedChange& change, const SpeedSegment& segment) {
  if (segment.duration > 0.0) {
    change.segments[change.count++] = segment;
    change.duration += segment.duration;
  }
}

/// target - stoppingSpeed(), as if rounded once: avoids cancellation for two large speeds near to
/// each other, so that the time for the remaining change is accurate.
double missingSpeed(double speed, double acceleration, double max_jerk, double target) noexcept {
  const double difference = target - speed;
  if (max_jerk == 0.0) {
    return difference;
  }
  const double part = difference - target;
  const double difference_lost = (target - (difference - part)) - (speed + part);
  const double square = acceleration * std::abs(acceleration);
  const double square_lost = std::fma(acceleration, std::abs(acceleration), -square);
  const double gained = square / (2.0 * max_jerk);
  const double gained_lost =
      (std::fma(-gained, 2.0 * max_jerk, square) + square_lost) / (2.0 * max_jerk);
  return (difference - gained) + (difference_lost - gained_lost);
}

}  // namespace

std::optional<MoveFault> faultOf(const SpeedMove& move) noexcept {
  // Each test is written so that NaN fails it.
  if (!(std::abs(move.speed) <= kMaxSpeed)) {
    return MoveFault{"speed must be within +-1e6 rad/s", move.speed};
  }
  if (!(move.max_acceleration > 0.0 && std::isfinite(move.max_acceleration))) {
    return MoveFault{"max_acceleration must be positive and finite, in rad/s^2",
                     move.max_acceleration};
  }
  if (!(move.max_jerk >= 0.0 && std::isfinite(move.max_jerk))) {
    return MoveFault{"max_jerk must be positive and finite, in rad/s^3, or 0 for no limit",
                     move.max_jerk};
  }
  if (!(move.dwell >= 0.0 && move.dwell <= kMaxDuration)) {
    return MoveFault{"dwell must be from 0 to 1e9 s", move.dwell};
  }
  return std::nullopt;
}

double stoppingSpeed(double speed, double acceleration, double max_jerk) noexcept {
  if (max_jerk == 0.0) {
    return speed;
  }
  return speed + acceleration * std::abs(acceleration) / (2.0 * max_jerk);
}

SpeedChange planSpeedChange(double speed, double acceleration, const SpeedMove& move) noexcept {
  const double limit = move.max_acceleration;
  const double jerk = move.max_jerk;
  const double missing = missingSpeed(speed, acceleration, jerk, move.speed);
  SpeedChange change;
  if (jerk == 0.0) {
    appendSegment(change, {std::abs(missing) / limit, speed, std::copysign(limit, missing), 0.0});
    return change;
  }

  // From here on in the direction of the move; without a deficit that is the acceleration's own.
  const double direction = std::copysign(1.0, missing != 0.0 ? missing : acceleration);
  const double deficit = std::abs(missing);
  const double start = direction * acceleration;
  const double forward_start = std::max(start, 0.0);
  const double peak = std::min(limit, std::sqrt(jerk * deficit + forward_start * forward_start));
  // Speed gained by going up to the peak and back, beyond what the start alone would gain; a start
  // above the limit gains nothing more on its way down to it.
  const double ramps = std::max(0.0, (peak - forward_start) * (peak + forward_start)) / jerk;

  const double first_jerk = direction * (peak >= start ? jerk : -jerk);
  const double first = std::abs(peak - start) / jerk;
  appendSegment(change, {first, speed, acceleration, first_jerk});
  if (peak == limit) {
    appendSegment(
        change, {(deficit - ramps) / limit,
                 speed + first * (acceleration + 0.5 * first * first_jerk), direction * peak, 0.0});
  }
  appendSegment(change, {peak / jerk, move.speed - direction * peak * peak / (2.0 * jerk),
                         direction * peak, -direction * jerk});
  return change;
}

}  // namespace whirl_twin
