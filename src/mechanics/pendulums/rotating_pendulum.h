// Rotating pendulum: a pendulum whose plane turns freely about the vertical with a hub of inertia
// J; nothing holds the speed (lecture notes, "rotating pendulum with perturbed speed"; errata
// E39-E41).
//
//   T = m l^2 (theta'^2 + sin^2 theta phi'^2) / 2 + J phi'^2 / 2,   V = m g l (1 - cos theta)
//
// phi is cyclic: p_phi = (J + m l^2 sin^2 theta) phi' is conserved. Without a hub (J = 0) the mass
// matrix is singular where theta = 0, as for any spherical pendulum in these angles.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/pendulums/turning_pendulum_sketch.h"

namespace whirl_twin {

struct RotatingPendulum {
  static constexpr const char* kName = "rotating_pendulum";
  static constexpr const char* kSummary = "pendulum and hub rotating freely about the vertical";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta", "rad", "from hanging, in the rotating plane"},
       {"phi", "rad", "of that plane about the vertical, counterclockwise from above"}}};

  double mass = 0.0;         ///< [kg], of the bob
  double length = 0.0;       ///< [m], pivot to bob
  double hub_inertia = 0.0;  ///< [kg m^2], about the vertical
  double damping = 0.0;      ///< [N m s/rad], viscous, on theta
  double gravity = 0.0;      ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<RotatingPendulum>, 4> parameters() {
    return {{{"mass", "kg", Range::kPositive, &RotatingPendulum::mass, "of the bob"},
             {"length", "m", Range::kPositive, &RotatingPendulum::length, "pivot to bob"},
             {"hub_inertia", "kg m^2", Range::kNotNegative, &RotatingPendulum::hub_inertia,
              "about the vertical"},
             {"damping", "N m s/rad", Range::kNotNegative, &RotatingPendulum::damping,
              "viscous, on theta", 0.0}}};
  }

  std::string singularMass() const {
    return hub_inertia == 0.0 ? "without a hub inertia there is no inertia about the vertical "
                                "while the pendulum hangs"
                              : "";
  }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"torque_theta", "N m", {1.0, 0.0}, "at the pivot, on the pendulum"},
             {"torque_phi", "N m", {0.0, 1.0}, "about the vertical, on the hub"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    const S across = sin(q[0]) * v[1];
    return (0.5 * mass * length * length) * (v[0] * v[0] + across * across) +
           (0.5 * hub_inertia) * (v[1] * v[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return (mass * gravity * length) * (1.0 - cos(q[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>&) const {
    return {};
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    return turningPendulumSketch(length, q[0], q[1], 0.3 * length);
  }
};

}  // namespace whirl_twin
