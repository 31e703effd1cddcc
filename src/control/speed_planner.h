// Set-points of speed that a motor can follow: the fastest changes within a limit of jerk J and
// speed-dependent limits of acceleration, one for rising and one for falling speed.
//
// With E = a^2 / 2 over the speed w, dE/dw = da/dt is the jerk. So the fastest change is the
// highest E(w) that is nowhere steeper than J and nowhere above A(w)^2 / 2, from a0^2 / 2 at the
// present speed to 0 at the target speed. (A start beyond a limit comes down at full jerk.) A(w) is
// a step function here, so that E is piecewise linear: pieces of constant jerk.
//
// Barred speed ranges are crossed at the largest acceleration that A and J allow there, with the
// run-up that the overall maximum of A requires (exclusion_bands.h).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "control/exclusion_bands.h"
#include "control/motor.h"
#include "control/speed_profile.h"

namespace whirl_twin {

/// Acceleration limits of a shaft on a motor.
struct ShaftLimits {
  Motor motor;                    ///< the most it gives at a speed, either way, and its drag
  double inertia = 0.0;           ///< [kg m^2], that it accelerates
  double reserve = 0.0;           ///< [-], share of its torque that is not planned with
  double max_acceleration = 0.0;  ///< [rad/s^2]

  /// The most it gives [N m] at a speed [rad/s], whichever way it turns.
  double torque(double speed) const noexcept;
  /// The largest rise of the size of a speed, and the largest fall [rad/s^2].
  double rise(double speed) const noexcept;
  double fall(double speed) const noexcept;
};

/// Consecutive pieces of constant jerk, ending at a constant speed.
struct SpeedPlan {
  std::vector<SpeedSegment> pieces;  ///< capacity for the maximum number
  std::size_t count = 0;
  double target = 0.0;    ///< [rad/s]
  double duration = 0.0;  ///< [s]
};

class SpeedPlanner {
 public:
  // Not real-time safe.

  /// max_jerk [rad/s^3] > 0. It plans up to the speed at which the motor has a thousandth of the
  /// largest acceleration left.
  SpeedPlanner(const ShaftLimits& limits, double max_jerk, ExclusionBands avoid);

  /// A plan with capacity for all pieces that stays at a speed [rad/s].
  SpeedPlan staying(double speed) const;

  // Real-time safe: no allocation, no lock, no exception.

  /// The largest speed [rad/s] that it plans to.
  double highest() const noexcept { return highest_; }
  const ExclusionBands& avoid() const noexcept { return avoid_; }
  /// Where a target goes: out of the bands; before: where the last one went, NaN without one.
  double allowed(double target, double before) const noexcept {
    return avoid_.allowed(target, limits_.max_acceleration, max_jerk_, before);
  }
  /// Plans from a speed and an acceleration to an allowed() speed. False, with the plan left alone,
  /// where that or what it takes to cross a band is beyond highest().
  bool plan(double speed, double acceleration, double target, SpeedPlan& plan) const noexcept;

 private:
  /// Steps of A(w), in the order of the sizes of speeds.
  struct Step {
    double from, to;    ///< [rad/s]
    double rise, fall;  ///< [rad/s^2]
  };
  void change(double speed, double acceleration, double target, SpeedPlan& plan) const noexcept;

  ShaftLimits limits_;
  double max_jerk_;
  ExclusionBands avoid_;
  std::vector<Step> steps_;
  double highest_ = 0.0;
};

/// Speed and acceleration a time [s] after the start of a plan; `cursor`, a position in the plan
/// not beyond that time, is advanced to it, and `begun` is the start time of that piece. Real-time
/// safe.
struct PlanCursor {
  std::size_t piece = 0;
  double begun = 0.0;  ///< [s]

  SpeedSegment at(const SpeedPlan& plan, double time) noexcept;
};

}  // namespace whirl_twin
