// A rigid disc that tilts on a massless flexible shaft (Stodola 1924; Green 1948; Genta, Dynamics
// of Rotating Systems, 2005): what its two forms share.
//
// x, y: the shaft's centre S at the disc. alpha, beta: tilt about x and y, right-handed, so that
// the shaft's slopes are b = (dx/dz, dy/dz) = (beta, -alpha). In each of the planes (x, b_x), (y,
// b_y)
//
//   V = k11 s^2 / 2 + k12 s b + k22 b^2 / 2
//
// for a shaft clamped at one end and the disc at the other k11 = 12 EI/L^3, k12 = -6 EI/L^2,
// k22 = 4 EI/L. The disc's own moment is Id b'' - i Ip w b' in b = b_x + i b_y: the gyroscopic part
// does no work, and has no term in w' (the driving torque acts about the disc's own axis). Its mass
// centre lies off S by the eccentricity, its principal axis off the shaft by the skew tau: the
// couple (Id - Ip) tau (w^2 - i w') e^(i theta).
#pragma once

#include <array>
#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"

namespace whirl_twin {

struct RigidDisc {
  static constexpr const char* kName = "rigid_disc_rotor";
  static constexpr const char* kSummary = "rigid disc that tilts on a massless flexible shaft";
  static constexpr std::size_t kDof = 4;
  static constexpr bool kLinear = true;
  static constexpr bool kHasShaft = true;

  double mass = 0.0;                    ///< [kg]
  double polar_inertia = 0.0;           ///< [kg m^2], Ip
  double transverse_inertia = 0.0;      ///< [kg m^2], Id
  double stiffness_displacement = 0.0;  ///< [N/m], k11
  double stiffness_coupling = 0.0;      ///< [N], k12: force by slope
  double stiffness_rotation = 0.0;      ///< [N m], k22
  double stiffness_asymmetry = 0.0;     ///< [-], k (1 +- it) along axes fixed in the shaft
  double damping_displacement = 0.0;    ///< [N s/m], external
  double damping_rotation = 0.0;        ///< [N m s], external
  double internal_damping = 0.0;        ///< [s], of the shaft's material, over its stiffness
  double eccentricity = 0.0;            ///< [m], of the mass centre
  double eccentricity_angle = 0.0;      ///< [rad], from the shaft's mark
  double skew = 0.0;                    ///< [rad], of the principal axis
  double skew_angle = 0.0;              ///< [rad], of its slope, from the shaft's mark
  double phase_mark = 0.0;              ///< [rad], that the phase counts from
  double gravity = 0.0;                 ///< [m/s^2], along -y

  static constexpr std::array<Parameter<RigidDisc>, 15> parameters() {
    using Disc = RigidDisc;
    constexpr Range kPlus = Range::kPositive;
    constexpr Range kNone = Range::kNotNegative;
    constexpr Range kAny = Range::kAny;
    return {{{"mass", "kg", kPlus, &Disc::mass, "of the disc"},
             {"polar_inertia", "kg m^2", kPlus, &Disc::polar_inertia, "about the shaft"},
             {"transverse_inertia", "kg m^2", kPlus, &Disc::transverse_inertia, "about a diameter"},
             {"stiffness_displacement", "N/m", kNone, &Disc::stiffness_displacement,
              "force by displacement, unless the shaft is overhung", 0.0},
             {"stiffness_coupling", "N", kAny, &Disc::stiffness_coupling,
              "force by slope, moment by displacement", 0.0},
             {"stiffness_rotation", "N m", kNone, &Disc::stiffness_rotation,
              "moment by slope, unless the shaft is overhung", 0.0},
             {"stiffness_asymmetry", "-", kNone, &Disc::stiffness_asymmetry,
              "of a shaft with unequal stiffness: k (1 +- this)", 0.0},
             {"damping_displacement", "N s/m", kNone, &Disc::damping_displacement,
              "external, on x and y", 0.0},
             {"damping_rotation", "N m s/rad", kNone, &Disc::damping_rotation,
              "external, on the tilt", 0.0},
             {"internal_damping", "s", kNone, &Disc::internal_damping,
              "of the shaft, over its stiffness, rotating with it", 0.0},
             {"eccentricity", "m", kNone, &Disc::eccentricity, "of the mass centre", 0.0},
             {"eccentricity_angle", "rad", kAny, &Disc::eccentricity_angle,
              "of the mass centre from the shaft's mark", 0.0},
             {"skew", "rad", kNone, &Disc::skew, "angle between the axes of disc and shaft", 0.0},
             {"skew_angle", "rad", kAny, &Disc::skew_angle,
              "of the slope that is the skew, from the shaft's mark", 0.0},
             {"phase_mark", "rad", kAny, &Disc::phase_mark,
              "reference of the whirl's phase, from the shaft's phase mark", 0.0}}};
  }

  /// The gyroscopic moment changes with it.
  bool speedDependent() const { return true; }

 protected:
  /// A displacement s and a slope b in one plane along the shaft.
  template <class S>
  WHIRL_TWIN_INLINE S bending(const S& s, const S& b) const {
    return (0.5 * stiffness_displacement) * (s * s) + stiffness_coupling * (s * b) +
           (0.5 * stiffness_rotation) * (b * b);
  }
  /// Kinetic energy of the disc, with velocity (vx, vy) of S and rates (bx, by) of the slopes, in
  /// axes at an angle `mark` [rad] behind the shaft's phase reference.
  template <class S>
  WHIRL_TWIN_INLINE S kineticOf(const S& vx, const S& vy, const S& bx, const S& by, const S& mark,
                                const S& speed) const {
    const S tangential = eccentricity * speed;
    const S x = vx - tangential * sin(mark + eccentricity_angle);
    const S y = vy + tangential * cos(mark + eccentricity_angle);
    const S couple = ((transverse_inertia - polar_inertia) * skew) * speed;
    return (0.5 * mass) * (x * x + y * y) + (0.5 * transverse_inertia) * (bx * bx + by * by) +
           couple * (by * cos(mark + skew_angle) - bx * sin(mark + skew_angle));
  }
};

}  // namespace whirl_twin
