// A Jeffcott rotor whose spin is free, driven by a constant torque: the unbalance acts back on the
// spin, and a weak motor is captured below the critical speed (Sommerfeld effect; lecture notes,
// "whirling shafts"; Dimentberg et al., Physics of Vibrations, 1997).
//
//   T = m/2 [(xi' - phi' eta)^2 + (eta' + phi' (xi + e))^2] + J phi'^2 / 2
//   V = k (xi^2 + eta^2) / 2
//   D = c/2 [(xi' - phi' eta)^2 + (eta' + phi' xi)^2] + d phi'^2 / 2,   Q = (0, 0, T_motor)
//
// xi, eta: the disc's centre in the disc-fixed rotating frame, xi towards the mass centre; x = xi
// cos(phi) - eta sin(phi). In this frame a steady whirl is stationary, so that the spin is cyclic
// and each steady speed, T_motor = d w + c w r(w)^2 with up to three solutions, is a relative
// equilibrium whose stability is evaluated: the middle one is unstable. J is about the mass centre.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
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
      {{"xi", "m", "of the disc's centre from the bearings' line, towards its mass centre"},
       {"eta", "m", "90 degrees ahead of xi"},
       {"spin", "rad", "of the shaft, in the direction of its torque"}}};

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

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {0.0, 0.0, 1.0}, "on the shaft, besides the motor's"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    const S x = v[0] - v[2] * q[1];
    const S y = v[1] + v[2] * (q[0] + eccentricity);
    return (0.5 * mass) * (x * x + y * y) + (0.5 * polar_inertia) * (v[2] * v[2]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return (0.5 * stiffness) * (q[0] * q[0] + q[1] * q[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    const S x = v[0] - v[2] * q[1];
    const S y = v[1] + v[2] * q[0];
    return (0.5 * damping) * (x * x + y * y) + (0.5 * drag) * (v[2] * v[2]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>&) const {
    return {S(0.0), S(0.0), S(torque)};
  }

  /// Seen along the shaft, the disc twenty eccentricities wide: the bearing line, the disc's centre
  /// and its heavy spot, to scale.
  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    const double e = naturalLength();
    const double c = std::cos(q[2]);
    const double d = std::sin(q[2]);
    const SketchPoint centre{q[0] * c - q[1] * d, 0.0, q[0] * d + q[1] * c};
    const SketchPoint heavy{centre.x + e * c, -0.9 * e, centre.z + e * d};
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
