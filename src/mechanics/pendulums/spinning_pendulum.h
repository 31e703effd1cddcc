// Spinning pendulum: a pendulum swinging in a vertical plane that is turned about the vertical axis
// through its pivot at the speed w of a shaft (lecture notes, "spinning pendulum"; Watt's
// governor).
//
//   T = m l^2 (theta'^2 + w^2 sin^2 theta) / 2,   V = m g l (1 - cos theta),   D = c theta'^2 / 2
//
// theta is measured from the hanging position. Past w^2 = g/l it hangs at cos theta = g / (l w^2).
#pragma once

#include <array>
#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/model_description.h"
#include "mechanics/pendulums/turning_pendulum_sketch.h"

namespace whirl_twin {

struct SpinningPendulum {
  static constexpr const char* kName = "spinning_pendulum";
  static constexpr const char* kSummary =
      "pendulum in a vertical plane that a shaft rotates about the vertical";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = true;
  static constexpr bool kHasShaftAngle = false;  ///< only a picture needs it
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta", "rad", "from hanging, in the rotating plane"}}};

  double mass = 0.0;     ///< [kg]
  double length = 0.0;   ///< [m]
  double damping = 0.0;  ///< [N m s/rad]
  double gravity = 0.0;  ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<SpinningPendulum>, 3> parameters() {
    return {{{"mass", "kg", Range::kPositive, &SpinningPendulum::mass, "of the bob"},
             {"length", "m", Range::kPositive, &SpinningPendulum::length, "pivot to bob"},
             {"damping", "N m s/rad", Range::kNotNegative, &SpinningPendulum::damping,
              "viscous, at the pivot", 0.0}}};
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {1.0}, "at the pivot, on the pendulum"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 1>& q, const std::array<S, 1>& v,
                              const EvaluationPoint<S>& at) const {
    const S across = at.speed * sin(q[0]);
    return (0.5 * mass * length * length) * (v[0] * v[0] + across * across);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 1>& q, const EvaluationPoint<S>&) const {
    return (mass * gravity * length) * (1.0 - cos(q[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 1>&, const std::array<S, 1>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 1> force(const std::array<S, 1>&, const std::array<S, 1>&,
                                           const EvaluationPoint<S>&) const {
    return {};
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>& at) const {
    return turningPendulumSketch(length, q[0], at.angle, 0.14 * length);
  }
};

}  // namespace whirl_twin
