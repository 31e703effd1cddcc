// Jeffcott rotor: a disc at the middle of a massless flexible shaft, its mass centre G a distance e
// from the shaft's centre S (Jeffcott 1919; lecture notes, "whirling of shafts").
//
//   T = m |v_G|^2 / 2,   G = S + e (cos phi, sin phi),   phi = shaft angle + eccentricity_angle
//   V = [k_x (x - b cos beta)^2 + k_y (y - b sin beta)^2] / 2 + m g y,   beta = shaft angle +
//       bow_angle
//   D = (c_x x'^2 + c_y y'^2) / 2 + c_i |v_S - w x r_S|^2 / 2 + c_f |v_S - lambda w x r_S|^2 / 2
//   Q = q (-y, x)
//
// x, y: position of S in the fixed frame of the bearings, so that there is no singularity where the
// whirl passes through the centre. b is a residual bow: the shaft's unloaded position rotates with
// the shaft (Nicholas, Gunter & Allaire, J. Engineering for Power 98, 1976). c_i acts on velocities
// seen from the rotating shaft (internal damping) and makes the rotor unstable above w = p (1 + c /
// c_i) (Kimball 1924). c_f is the damping of a fluid that rotates at lambda times the shaft's
// speed, lambda about one half in a seal or bearing: unstable above w = p (1 + c / c_f) / lambda,
// whirling at about lambda w (Muszynska, J. Sound and Vibration 110, 1986). q is a cross-coupled
// stiffness, kxy = +q, kyx = -q, of any other origin: unstable above c p. The speed is the drive's.
//
// These are the linear effects; nonlinear_jeffcott_rotor.h and journal_jeffcott_rotor.h have the
// nonlinear ones. All forms share the parameters of this one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"

namespace whirl_twin {

struct JeffcottRotor {
  static constexpr const char* kName = "jeffcott_rotor";
  static constexpr const char* kSummary = "unbalanced disc on a massless flexible shaft";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = true;
  static constexpr bool kHasShaft = true;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m", "of the shaft's centre at the disc, from the bearings' line"},
       {"y", "m", "likewise, up, 90 degrees ahead of x"}}};

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
  double phase_mark = 0.0;          ///< [rad], that the phase counts from
  double bow = 0.0;                 ///< [m], of the shaft at rest
  double bow_angle = 0.0;           ///< [rad], from the shaft's reference mark
  double polar_inertia = 0.0;       ///< [kg m^2], about the mass centre; with a motor
  double gravity = 0.0;             ///< [m/s^2], along -y

  double loss_factor = 0.0;    ///< [-], hysteresis of the shaft's material
  double rub_stiffness = 0.0;  ///< [N/m], of the stator
  double rub_clearance = 0.0;  ///< [m], between rotor and stator
  double rub_friction = 0.0;   ///< [-], coefficient of friction there
  double rub_damping = 0.0;    ///< [N s/m], normal to the surface
  double rotor_radius = 0.0;   ///< [m], where it rubs

  double bearing_length = 0.0;     ///< [m]
  double bearing_diameter = 0.0;   ///< [m]
  double bearing_clearance = 0.0;  ///< [m], radial
  double bearing_viscosity = 0.0;  ///< [Pa s]
  double journal_mass = 0.0;       ///< [kg], of both journals

  static constexpr std::array<Parameter<JeffcottRotor>, 26> parameters() {
    using Rotor = JeffcottRotor;
    constexpr Range kPlus = Range::kPositive;
    constexpr Range kNone = Range::kNotNegative;
    constexpr Range kAny = Range::kAny;
    return {{{"mass", "kg", kPlus, &Rotor::mass, "of the disc"},
             {"stiffness", "N/m", kPlus, &Rotor::stiffness, "of the shaft at the disc, along x"},
             {"stiffness_y", "N/m", kPlus, &Rotor::stiffness_y, "along y, if it differs", kGiven,
              "stiffness"},
             {"damping", "N s/m", kNone, &Rotor::damping, "external, along x", 0.0},
             {"damping_y", "N s/m", kNone, &Rotor::damping_y, "external, along y, if it differs",
              kGiven, "damping"},
             {"internal_damping", "N s/m", kNone, &Rotor::internal_damping,
              "rotating with the shaft", 0.0},
             {"fluid_damping", "N s/m", kNone, &Rotor::fluid_damping,
              "of a fluid that rotates with the shaft", 0.0},
             {"fluid_ratio", "-", kNone, &Rotor::fluid_ratio,
              "ratio of the fluid's speed to the shaft's", 0.0},
             {"cross_coupling", "N/m", kAny, &Rotor::cross_coupling,
              "cross-coupled stiffness: kxy = +q, kyx = -q", 0.0},
             {"eccentricity", "m", kNone, &Rotor::eccentricity, "of the mass centre", 0.0},
             {"eccentricity_angle", "rad", kAny, &Rotor::eccentricity_angle,
              "of the mass centre from the shaft's mark", 0.0},
             {"bow", "m", kNone, &Rotor::bow, "residual bow of the shaft", 0.0},
             {"bow_angle", "rad", kAny, &Rotor::bow_angle, "of the bow from the shaft's mark", 0.0},
             {"polar_inertia", "kg m^2", kNone, &Rotor::polar_inertia,
              "about the mass centre, needed with a motor", 0.0},
             {"loss_factor", "-", kNone, &Rotor::loss_factor,
              "hysteresis of the shaft, independent of the rate", 0.0},
             {"rub_stiffness", "N/m", kNone, &Rotor::rub_stiffness, "of the stator at a rub", 0.0},
             {"rub_clearance", "m", kNone, &Rotor::rub_clearance, "between rotor and stator", 0.0},
             {"rub_friction", "-", kNone, &Rotor::rub_friction, "between rotor and stator", 0.0},
             {"rub_damping", "N s/m", kNone, &Rotor::rub_damping, "of the stator, radial", 0.0},
             {"rotor_radius", "m", kNone, &Rotor::rotor_radius,
              "of the rubbing surface, needed with rub_friction", 0.0},
             {"bearing_length", "m", kNone, &Rotor::bearing_length,
              "of each of two short journal bearings", 0.0},
             {"bearing_diameter", "m", kNone, &Rotor::bearing_diameter, "of the journals", 0.0},
             {"bearing_clearance", "m", kNone, &Rotor::bearing_clearance, "radial", 0.0},
             {"bearing_viscosity", "Pa s", kNone, &Rotor::bearing_viscosity, "of the oil", 0.0},
             {"journal_mass", "kg", kNone, &Rotor::journal_mass, "of both journals", 0.0},
             {"phase_mark", "rad", kAny, &Rotor::phase_mark,
              "reference of the whirl's phase, from the shaft's phase mark", 0.0}}};
  }

  /// The matrices change with speed: no exact step while the speed changes.
  bool speedDependent() const {
    return internal_damping != 0.0 || fluid_damping * fluid_ratio != 0.0;
  }
  /// [rad], that the phase counts from.
  double phaseMark() const { return phase_mark; }
  /// Without synchronous forces: for its equilibrium and stability.
  JeffcottRotor balanced() const { return withoutUnbalance(*this); }
  /// The same of a rotor made of this one.
  template <class Rotor>
  static Rotor withoutUnbalance(Rotor rotor) {
    rotor.eccentricity = rotor.bow = 0.0;
    return rotor;
  }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"force_x", "N", {1.0, 0.0}, "on the disc, along x"},
             {"force_y", "N", {0.0, 1.0}, "on the disc, along y"}}};
  }

  // What is absent costs a branch that is always foretold, not its arithmetic.

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>&, const std::array<S, 2>& v,
                              const EvaluationPoint<S>& at) const {
    const S heavy_spot = at.angle + eccentricity_angle;
    const S tangential = eccentricity * at.speed;
    const S x = v[0] - tangential * sin(heavy_spot);
    const S y = v[1] + tangential * cos(heavy_spot);
    return (0.5 * mass) * (x * x + y * y);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const EvaluationPoint<S>& at) const {
    const S bent = bending(q, at);
    return gravity == 0.0 ? bent : bent + (mass * gravity) * q[1];
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>& q, const std::array<S, 2>& v,
                                  const EvaluationPoint<S>& at) const {
    return externalDissipation(q, v, at) + internalDissipation(q, v, at);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 2> force(const std::array<S, 2>& q, const std::array<S, 2>&,
                                           const EvaluationPoint<S>&) const {
    return {-cross_coupling * q[1], cross_coupling * q[0]};
  }

 protected:
  /// Of a shaft deflected by r.
  template <class S>
  WHIRL_TWIN_INLINE S bending(const std::array<S, 2>& r, const EvaluationPoint<S>& at) const {
    if (bow == 0.0) {
      return (0.5 * stiffness) * (r[0] * r[0]) + (0.5 * stiffness_y) * (r[1] * r[1]);
    }
    const S x = r[0] - bow * cos(at.angle + bow_angle);
    const S y = r[1] - bow * sin(at.angle + bow_angle);
    return (0.5 * stiffness) * (x * x) + (0.5 * stiffness_y) * (y * y);
  }
  /// Of what surrounds the disc.
  template <class S>
  WHIRL_TWIN_INLINE S externalDissipation(const std::array<S, 2>& q, const std::array<S, 2>& v,
                                          const EvaluationPoint<S>& at) const {
    const S d = (0.5 * damping) * (v[0] * v[0]) + (0.5 * damping_y) * (v[1] * v[1]);
    if (fluid_damping == 0.0) {
      return d;
    }
    const S turning = fluid_ratio * at.speed;
    const S x = v[0] + turning * q[1];
    const S y = v[1] - turning * q[0];
    return d + (0.5 * fluid_damping) * (x * x + y * y);
  }
  /// Of the shaft, where its deflection is r and changes by v.
  template <class S>
  WHIRL_TWIN_INLINE S internalDissipation(const std::array<S, 2>& r, const std::array<S, 2>& v,
                                          const EvaluationPoint<S>& at) const {
    const S x = v[0] + at.speed * r[1];
    const S y = v[1] - at.speed * r[0];
    return (0.5 * internal_damping) * (x * x + y * y);
  }

 private:
  static constexpr double kGiven = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace whirl_twin
