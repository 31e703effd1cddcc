// A Jeffcott rotor whose spin is free, driven by a constant torque: the unbalance acts back on the
// spin, and a weak motor hangs below the critical speed (Sommerfeld effect; lecture notes,
// "whirling shafts"; Dimentberg et al., Physics of Vibrations, 1997).
//
//   T = m/2 |v_G|^2 + J phi'^2 / 2,   G at e (cos phi, sin phi) from the disc's centre S = (x, y)
//   V = k (x^2 + y^2) / 2,   D = c (x'^2 + y'^2) / 2 + d phi'^2 / 2,   Q = (0, 0, T_motor)
//
// J is about the mass centre. Steady spin w balances the motor: T_motor = d w + c w r(w)^2, with up
// to three solutions, the middle one unstable.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/moment.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct FreeRotor {
  static constexpr const char* kName = "free_rotor";
  static constexpr const char* kSummary =
      "unbalanced disc on a flexible shaft whose spin is free, driven by a torque";
  static constexpr std::size_t kDof = 3;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m"}, {"y", "m"}, {"spin", "rad"}}};

  double mass = 0.0;           ///< [kg], of the disc
  double stiffness = 0.0;      ///< [N/m], of the shaft, along x and y
  double damping = 0.0;        ///< [N s/m], external
  double eccentricity = 0.0;   ///< [m], of the mass centre
  double polar_inertia = 0.0;  ///< [kg m^2], about the mass centre
  double torque = 0.0;         ///< [N m], of the motor
  double drag = 0.0;           ///< [N m s/rad], on the spin

  static constexpr std::array<Parameter<FreeRotor>, 7> parameters() {
    return {{{"mass", "kg", Range::kPositive, &FreeRotor::mass, "of the disc"},
             {"stiffness", "N/m", Range::kPositive, &FreeRotor::stiffness,
              "of the shaft, along x and y"},
             {"damping", "N s/m", Range::kNotNegative, &FreeRotor::damping, "external", 0.0},
             {"eccentricity", "m", Range::kNotNegative, &FreeRotor::eccentricity,
              "of the mass centre", 0.0},
             {"polar_inertia", "kg m^2", Range::kPositive, &FreeRotor::polar_inertia,
              "about the mass centre"},
             {"torque", "N m", Range::kAny, &FreeRotor::torque, "of the motor, constant", 0.0},
             {"drag", "N m s/rad", Range::kNotNegative, &FreeRotor::drag, "on the spin", 0.0}}};
  }

  /// A whirl is some eccentricities wide.
  double naturalLength() const { return eccentricity > 0.0 ? eccentricity : 1.0; }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const Moment<S>&) const {
    const S across = eccentricity * v[2];
    const S vx = v[0] - across * sin(q[2]);
    const S vy = v[1] + across * cos(q[2]);
    return (0.5 * mass) * (vx * vx + vy * vy) + (0.5 * polar_inertia) * (v[2] * v[2]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const Moment<S>&) const {
    return (0.5 * stiffness) * (q[0] * q[0] + q[1] * q[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const Moment<S>&) const {
    return (0.5 * damping) * (v[0] * v[0] + v[1] * v[1]) + (0.5 * drag) * (v[2] * v[2]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&, const Moment<S>&) const {
    return {S(0.0), S(0.0), S(torque)};
  }

  /// Seen along the shaft, the disc twenty eccentricities wide: the bearing line, the disc's centre
  /// and its heavy spot, to scale.
  Sketch sketch(const std::array<double, kDof>& q, const Moment<double>&) const {
    const double e = naturalLength();
    const SketchPoint centre{q[0], 0.0, q[1]};
    const SketchPoint heavy{q[0] + e * std::cos(q[2]), -0.9 * e, q[1] + e * std::sin(q[2])};
    Sketch s;
    s.size = 44.0 * e;
    s.height = 44.0 * e;
    s.discs.push_back({centre,
                       {0.0, 1.0, 0.0},
                       10.0 * e,
                       e,
                       0.5 * 3.14159265358979323846 - q[2],
                       SketchRole::kBody});
    s.springs.push_back({{0.0, 0.5 * e, 0.0}, centre, 0.3 * e});
    s.balls.push_back({heavy, 0.6 * e, SketchRole::kMass});
    s.balls.push_back({{0.0, -0.9 * e, 0.0}, 0.4 * e, SketchRole::kSupport});
    s.tracer = centre;
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
