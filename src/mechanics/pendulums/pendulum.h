// A pendulum: a body that hangs from a pivot, turned by a torque there. With its mass at one point
// it is the simple pendulum (lecture notes, "simple pendulum"); a rig with a motor has friction of
// its own and an inertia beside m l^2.
//
//   T = (I + m l^2) theta'^2 / 2,   V = m g l (1 - cos theta),
//   D = c theta'^2 / 2 + Mc s(theta'),   s(w) = sqrt(w^2 + w0^2)
//
// w0 is `coulomb_rate`; with 0 the Coulomb friction can hold (dry_friction.h).
#pragma once

#include <array>
#include <cstddef>

#include "mechanics/dry_friction.h"
#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct Pendulum {
  static constexpr const char* kName = "pendulum";
  static constexpr const char* kSummary = "a body that hangs from a pivot, with or without a motor";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta", "rad", "from hanging, the body to the right"}}};

  double mass = 0.0;          ///< [kg]
  double length = 0.0;        ///< [m], pivot to mass centre
  double inertia = 0.0;       ///< [kg m^2], about the mass centre, and of a motor's rotor
  double damping = 0.0;       ///< [N m s/rad]
  double coulomb = 0.0;       ///< [N m]
  double coulomb_rate = 0.0;  ///< [rad/s], w0: within it Coulomb friction is rounded off
  double gravity = 0.0;       ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<Pendulum>, 6> parameters() {
    return {{{"mass", "kg", Range::kPositive, &Pendulum::mass, "of the body"},
             {"length", "m", Range::kPositive, &Pendulum::length, "pivot to mass centre"},
             {"inertia", "kg m^2", Range::kNotNegative, &Pendulum::inertia,
              "of the body about its mass centre, with parts that rotate with it", 0.0},
             {"damping", "N m s/rad", Range::kNotNegative, &Pendulum::damping,
              "viscous, at the pivot", 0.0},
             {"coulomb", "N m", Range::kNotNegative, &Pendulum::coulomb,
              "Coulomb friction at the pivot", 0.0},
             {"coulomb_rate", "rad/s", Range::kNotNegative, &Pendulum::coulomb_rate,
              "rate of regularization of the Coulomb friction; 0: exact, with sticking", 0.0}}};
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {1.0}, "at the pivot, on the pendulum"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 1>&, const std::array<S, 1>& v,
                              const EvaluationPoint<S>&) const {
    return (0.5 * (inertia + mass * length * length)) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 1>& q, const EvaluationPoint<S>&) const {
    return (mass * gravity * length) * (1.0 - cos(q[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 1>&, const std::array<S, 1>& v,
                                  const EvaluationPoint<S>&) const {
    S d = (0.5 * damping) * (v[0] * v[0]);
    if (coulomb != 0.0) {
      d = d + dryDissipation(coulomb, coulomb_rate, v[0]);
    }
    return d;
  }
  DryContacts<kDof> dryContacts() const {
    DryContacts<kDof> contacts;
    contacts.add({"at the pivot", "N m", {1.0}, coulomb}, coulomb_rate);
    return contacts;
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 1> force(const std::array<S, 1>&, const std::array<S, 1>&,
                                           const EvaluationPoint<S>&) const {
    return {};
  }

  Sketch sketch(const std::array<double, 1>& q, const EvaluationPoint<double>&) const {
    const SketchPoint end = hangingPoint({}, length, q[0]);
    Sketch s;
    s.size = 2.3 * length;
    s.rods = {{{}, end, 0.03 * length, SketchRole::kBody}};
    addPin(s, {});
    s.balls = {{end, 0.14 * length, SketchRole::kMass}};
    s.tracer = end;
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
