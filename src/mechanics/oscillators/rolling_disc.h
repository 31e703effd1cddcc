// Disc rolling without slip between a spring and a damper at its centre, with a point mass off its
// centre if wanted (lecture notes, "rolling disc" and "rolling disc with off-centre mass";
// E05-E07).
//
//   T = x'^2 / 2 [M + J/r^2 + m (1 + l^2/r^2 - (2 l/r) cos(x/r))]
//   V = k x^2 / 2 + m g l (1 - cos(x/r)),   D = c x'^2 / 2       the mass below the centre at x = 0
#pragma once

#include <array>
#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/moment.h"

namespace whirl_twin {

struct RollingDisc {
  static constexpr const char* kName = "rolling_disc";
  static constexpr const char* kSummary =
      "disc rolling against a spring and damper, with an off-centre mass";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{{{"x", "m"}}};

  double disc_mass = 0.0;     ///< [kg], of the disc
  double disc_inertia = 0.0;  ///< [kg m^2], about its centre
  double radius = 0.0;        ///< [m], of the disc
  double stiffness = 0.0;     ///< [N/m], of the spring
  double damping = 0.0;       ///< [N s/m], of the damper
  double offset_mass = 0.0;   ///< [kg], point mass on the disc
  double offset = 0.0;        ///< [m], of it below the centre at x = 0
  double gravity = 0.0;       ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<RollingDisc>, 7> parameters() {
    return {{{"disc_mass", "kg", Range::kPositive, &RollingDisc::disc_mass, "of the disc"},
             {"disc_inertia", "kg m^2", Range::kNotNegative, &RollingDisc::disc_inertia,
              "about its centre"},
             {"radius", "m", Range::kPositive, &RollingDisc::radius, "of the disc"},
             {"stiffness", "N/m", Range::kNotNegative, &RollingDisc::stiffness, "of the spring"},
             {"damping", "N s/m", Range::kNotNegative, &RollingDisc::damping, "of the damper", 0.0},
             {"offset_mass", "kg", Range::kNotNegative, &RollingDisc::offset_mass,
              "point mass on the disc", 0.0},
             {"offset", "m", Range::kNotNegative, &RollingDisc::offset,
              "of it below the centre at x = 0", 0.0}}};
  }

  /// The radius: its equilibria are radians of rolling apart.
  double naturalLength() const { return radius; }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const Moment<S>&) const {
    const double ratio = offset / radius;
    return (0.5 * (disc_mass + disc_inertia / (radius * radius))) * (v[0] * v[0]) +
           (0.5 * offset_mass) *
               ((1.0 + ratio * ratio - 2.0 * ratio * cos((1.0 / radius) * q[0])) * (v[0] * v[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const Moment<S>&) const {
    return (0.5 * stiffness) * (q[0] * q[0]) +
           (offset_mass * gravity * offset) * (1.0 - cos((1.0 / radius) * q[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const Moment<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&, const Moment<S>&) const {
    return {};
  }
};

}  // namespace whirl_twin
