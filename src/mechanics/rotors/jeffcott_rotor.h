// Jeffcott rotor: a disc at the middle of a massless flexible shaft, its mass centre G a distance e
// from the shaft's centre S (Jeffcott 1919; lecture notes, "whirling of shafts").
//
//   T = m |v_G|^2 / 2,   G = S + e (cos phi, sin phi),   phi = shaft angle + eccentricity_angle
//   V = (k_x x^2 + k_y y^2) / 2
//   D = (c_x x'^2 + c_y y'^2) / 2 + c_i |v_S - w x r_S|^2 / 2 + c_f |v_S|^2 / 2
//   Q = (lambda c_f w + q) (-y, x)
//
// x, y: position of S in the fixed frame of the bearings, so that nothing is singular where the
// whirl passes through the centre. c_i acts on velocities seen from the rotating shaft (internal
// damping) and makes the rotor unstable above w = p (1 + c / c_i) (Kimball 1924). c_f is a fluid
// that turns with the part lambda of the shaft's speed, about one half in a seal or bearing:
// unstable above w = p (1 + c / c_f) / lambda, whirling at about lambda w (Muszynska, J. Sound and
// Vibration 110, 1986). q is a cross-coupled stiffness, kxy = +q, kyx = -q, of any other origin:
// unstable above c p. The speed is the drive's.
#pragma once

#include <array>
#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/model_description.h"
#include "mechanics/moment.h"

namespace whirl_twin {

struct JeffcottRotor {
  static constexpr const char* kName = "jeffcott_rotor";
  static constexpr const char* kSummary = "unbalanced disc on a massless flexible shaft";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = true;
  static constexpr bool kHasShaft = true;
  static constexpr std::array<Coordinate, kDof> kCoordinates{{{"x", "m"}, {"y", "m"}}};

  double mass = 0.0;                ///< [kg]
  double stiffness = 0.0;           ///< [N/m], along x
  double stiffness_y = 0.0;         ///< [N/m], along y
  double damping = 0.0;             ///< [N s/m], along x
  double damping_y = 0.0;           ///< [N s/m], along y
  double internal_damping = 0.0;    ///< [N s/m], rotating with the shaft
  double fluid_damping = 0.0;       ///< [N s/m], of the fluid around the rotor
  double fluid_ratio = 0.0;         ///< [-], its mean speed of rotation over the shaft's
  double cross_coupling = 0.0;      ///< [N/m], kxy = +q, kyx = -q
  double eccentricity = 0.0;        ///< [m]
  double eccentricity_angle = 0.0;  ///< [rad], from the shaft's reference mark

  static constexpr std::array<Parameter<JeffcottRotor>, 11> parameters() {
    return {{{"mass", "kg", Range::kPositive, &JeffcottRotor::mass, "of the disc"},
             {"stiffness", "N/m", Range::kPositive, &JeffcottRotor::stiffness,
              "of the shaft at the disc, along x"},
             {"stiffness_y", "N/m", Range::kPositive, &JeffcottRotor::stiffness_y,
              "along y, if it differs", kGiven, "stiffness"},
             {"damping", "N s/m", Range::kNotNegative, &JeffcottRotor::damping, "external, along x",
              0.0},
             {"damping_y", "N s/m", Range::kNotNegative, &JeffcottRotor::damping_y,
              "external, along y, if it differs", kGiven, "damping"},
             {"internal_damping", "N s/m", Range::kNotNegative, &JeffcottRotor::internal_damping,
              "rotating with the shaft", 0.0},
             {"fluid_damping", "N s/m", Range::kNotNegative, &JeffcottRotor::fluid_damping,
              "of a fluid that turns with the shaft", 0.0},
             {"fluid_ratio", "-", Range::kNotNegative, &JeffcottRotor::fluid_ratio,
              "speed of the fluid's rotation over the shaft's", 0.0},
             {"cross_coupling", "N/m", Range::kAny, &JeffcottRotor::cross_coupling,
              "cross-coupled stiffness: kxy = +q, kyx = -q", 0.0},
             {"eccentricity", "m", Range::kNotNegative, &JeffcottRotor::eccentricity,
              "of the mass centre", 0.0},
             {"eccentricity_angle", "rad", Range::kAny, &JeffcottRotor::eccentricity_angle,
              "of the mass centre from the shaft's mark", 0.0}}};
  }

  /// The matrices change with speed: no exact step while the speed changes.
  bool speedDependent() const {
    return internal_damping != 0.0 || fluid_damping * fluid_ratio != 0.0;
  }
  /// [rad], angle of the unbalance from the shaft's mark.
  double unbalanceAngle() const { return eccentricity_angle; }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>&, const std::array<S, 2>& v,
                              const Moment<S>& at) const {
    const S heavy_spot = at.angle + eccentricity_angle;
    const S tangential = eccentricity * at.speed;
    const S x = v[0] - tangential * sin(heavy_spot);
    const S y = v[1] + tangential * cos(heavy_spot);
    return (0.5 * mass) * (x * x + y * y);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const Moment<S>&) const {
    return (0.5 * stiffness) * (q[0] * q[0]) + (0.5 * stiffness_y) * (q[1] * q[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>& q, const std::array<S, 2>& v,
                                  const Moment<S>& at) const {
    const S x = v[0] + at.speed * q[1];
    const S y = v[1] - at.speed * q[0];
    return (0.5 * (damping + fluid_damping)) * (v[0] * v[0]) +
           (0.5 * (damping_y + fluid_damping)) * (v[1] * v[1]) +
           (0.5 * internal_damping) * (x * x + y * y);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 2> force(const std::array<S, 2>& q, const std::array<S, 2>&,
                                           const Moment<S>& at) const {
    const S forward = fluid_ratio * fluid_damping * at.speed + cross_coupling;
    return {-1.0 * (forward * q[1]), forward * q[0]};
  }

 private:
  static constexpr double kGiven = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace whirl_twin
