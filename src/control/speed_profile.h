// A change of shaft speed at limited acceleration A and jerk J, the third-order velocity problem
// with the acceleration free at the start and zero at the end. It is one half of the double-S
// profile of L. Biagiotti, C. Melchiorri, "Trajectory Planning for Automatic Machines and Robots",
// Springer 2008, sec. 3.4.
//
// Bringing the present acceleration a0 to zero at full jerk ends at v_stop = v0 + a0 |a0| / (2 J);
// the move goes in the direction d = sign(v1 - v_stop). In that direction (alpha = d a, deficit
// delta = d (v1 - v_stop) >= 0) it jerks to a peak acceleration, holds it, and jerks to zero:
//
//   peak = min(A, sqrt(J delta + max(alpha0, 0)^2)),  hold = what is then left of delta, over A.
//
// A start beyond the limit, |a0| > A, is first brought down at full jerk. The move is the fastest
// one within the limits and does not overshoot v1 unless v_stop itself lies beyond it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace whirl_twin {

/// Largest shaft speed accepted [rad/s]; with kMaxDuration it keeps angles below 1e15 rad.
constexpr double kMaxSpeed = 1.0e6;

/// Longest move, dwell or profile accepted [s], 31 years.
constexpr double kMaxDuration = 1.0e9;

/// One move of a speed profile: a change of speed, then a dwell.
struct SpeedMove {
  double speed = 0.0;             ///< [rad/s], at the end of the change
  double max_acceleration = 0.0;  ///< [rad/s^2], > 0
  double max_jerk = 0.0;          ///< [rad/s^3]; 0: unlimited, constant acceleration
  double dwell = 0.0;             ///< [s], at `speed` afterwards
};

/// A piece of constant jerk.
struct SpeedSegment {
  double duration = 0.0;      ///< [s]; the last piece of a profile has no end: infinity
  double speed = 0.0;         ///< [rad/s], at its start
  double acceleration = 0.0;  ///< [rad/s^2], at its start
  double jerk = 0.0;          ///< [rad/s^3]

  bool constant() const noexcept { return acceleration == 0.0 && jerk == 0.0; }
};

/// A planned change of speed: at most three pieces, none of them empty.
struct SpeedChange {
  static constexpr std::size_t kMaxPieces = 3;

  std::array<SpeedSegment, kMaxPieces> segments;
  std::size_t count = 0;
  double duration = 0.0;  ///< [s]
};

/// An error of a move.
struct MoveFault {
  const char* expected;  ///< the field, what it must be, its unit
  double found;
};

/// The first fault of a move, if any. Real-time safe.
std::optional<MoveFault> faultOf(const SpeedMove& move) noexcept;

/// The speed [rad/s] reached if an acceleration [rad/s^2] is brought to zero at max_jerk [rad/s^3];
/// 0 jerk is no limit: the present speed.
double stoppingSpeed(double speed, double acceleration, double max_jerk) noexcept;

/// The fastest change from a speed [rad/s] and acceleration [rad/s^2] to the move's speed within
/// its limits. Without a jerk limit the acceleration jumps. The move must be valid (faultOf).
/// Real-time safe.
SpeedChange planSpeedChange(double speed, double acceleration, const SpeedMove& move) noexcept;

}  // namespace whirl_twin
