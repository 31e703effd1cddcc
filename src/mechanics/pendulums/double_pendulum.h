// Double pendulum: two point masses on massless rods in a vertical plane, each angle measured from
// the vertical (absolute angles), exact (lecture notes, "double pendulum"; errata E11 and note i).
//
//   T = m1 |v1|^2 / 2 + m2 |v2|^2 / 2,   V = -m1 g y1 - m2 g y2   (zero hanging at rest)
//
// The kinetic energy is written in the bobs' Cartesian velocities: that costs fewer dual operations
// than the expanded cosine form.
#pragma once

#include <array>
#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/model_description.h"
#include "mechanics/moment.h"

namespace whirl_twin {

struct DoublePendulum {
  static constexpr const char* kName = "double_pendulum";
  static constexpr const char* kSummary = "two rods and bobs in a vertical plane, absolute angles";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta1", "rad"}, {"theta2", "rad"}}};

  double mass1 = 0.0;     ///< [kg]
  double mass2 = 0.0;     ///< [kg]
  double length1 = 0.0;   ///< [m]
  double length2 = 0.0;   ///< [m]
  double damping1 = 0.0;  ///< [N m s/rad], at the upper joint
  double damping2 = 0.0;  ///< [N m s/rad], at the lower joint
  double gravity = 0.0;   ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<DoublePendulum>, 6> parameters() {
    return {{{"mass1", "kg", Range::kPositive, &DoublePendulum::mass1, "of the upper bob"},
             {"mass2", "kg", Range::kPositive, &DoublePendulum::mass2, "of the lower bob"},
             {"length1", "m", Range::kPositive, &DoublePendulum::length1, "of the upper rod"},
             {"length2", "m", Range::kPositive, &DoublePendulum::length2, "of the lower rod"},
             {"damping1", "N m s/rad", Range::kNotNegative, &DoublePendulum::damping1,
              "viscous, at the upper joint", 0.0},
             {"damping2", "N m s/rad", Range::kNotNegative, &DoublePendulum::damping2,
              "viscous, at the lower joint", 0.0}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>& q, const std::array<S, 2>& v,
                              const Moment<S>&) const {
    const S c1 = cos(q[0]);
    const S s1 = sin(q[0]);
    const S x1 = length1 * (c1 * v[0]);
    const S y1 = length1 * (s1 * v[0]);
    const S x2 = x1 + length2 * (cos(q[1]) * v[1]);
    const S y2 = y1 + length2 * (sin(q[1]) * v[1]);
    return (0.5 * mass1 * length1 * length1) * (v[0] * v[0]) + (0.5 * mass2) * (x2 * x2 + y2 * y2);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const Moment<S>&) const {
    return ((mass1 + mass2) * gravity * length1) * (1.0 - cos(q[0])) +
           (mass2 * gravity * length2) * (1.0 - cos(q[1]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>&, const std::array<S, 2>& v,
                                  const Moment<S>&) const {
    const S relative = v[1] - v[0];
    return (0.5 * damping1) * (v[0] * v[0]) + (0.5 * damping2) * (relative * relative);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 2> force(const std::array<S, 2>&, const std::array<S, 2>&,
                                           const Moment<S>&) const {
    return {};
  }
};

}  // namespace whirl_twin
