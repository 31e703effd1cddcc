// A rotor whose spin is free, turned by a motor: one coordinate more, the angle of its shaft.
//
//   T = T_rotor(q, v, phi, phi') + J phi'^2 / 2,   V = V_rotor(q, phi)
//   D = D_rotor(q, v, phi') + d phi'^2 / 2,   Q = (Q_rotor, T_motor(phi'))
//
// J is about the mass centre: what an eccentricity adds, m e^2, is in T_rotor. The angle and the
// speed of the shaft being variables, the moments of unbalance, bow, rotating damping, fluid and
// rub on the spin are the derivatives of the same energies that give their forces, and the energies
// close. (Sommerfeld effect: lecture notes, "whirling shafts"; Dimentberg et al., Physics of
// Vibrations, 1997.)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

#include "control/motor.h"
#include "mechanics/dynamics.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/lagrangian_dynamics.h"
#include "mechanics/model_description.h"
#include "mechanics/reaction.h"

namespace whirl_twin {

template <std::size_t n>
constexpr std::array<Coordinate, n + 1> withSpin(const std::array<Coordinate, n>& coordinates) {
  std::array<Coordinate, n + 1> all{};
  for (std::size_t i = 0; i < n; ++i) {
    all[i] = coordinates[i];
  }
  all[n] = {"spin", "rad", "of the shaft, in the sense of its motor"};
  return all;
}

template <class Rotor>
struct FreeSpin : Rotor {
  static constexpr std::size_t kSpin = Rotor::kDof;  ///< place of the spin among the coordinates
  static constexpr std::size_t kDof = Rotor::kDof + 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates = withSpin(Rotor::kCoordinates);

  Motor motor;

  static constexpr auto parameters() { return inherited<FreeSpin>(Rotor::parameters()); }
  FreeSpin balanced() const {
    FreeSpin same = *this;
    static_cast<Rotor&>(same) = Rotor::balanced();
    return same;
  }

  /// Those of the rotor, and a torque on its shaft.
  auto inputs() const {
    const auto whirling = Rotor::inputs();
    std::array<Input<kDof>, std::tuple_size<decltype(whirling)>::value + 1> all{};
    for (std::size_t i = 0; i < whirling.size(); ++i) {
      all[i] = {whirling[i].name, whirling[i].unit, {}, whirling[i].meaning};
      std::copy(whirling[i].direction.begin(), whirling[i].direction.end(),
                all[i].direction.begin());
    }
    all.back() = {"torque", "N m", {}, "on the shaft, besides the motor's"};
    all.back().direction[kSpin] = 1.0;
    return all;
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>& at) const {
    return Rotor::kinetic(whirl(q), whirl(v), shaft(q, v[kSpin], at)) +
           (0.5 * Rotor::polar_inertia) * (v[kSpin] * v[kSpin]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>& at) const {
    return Rotor::potential(whirl(q), shaft(q, S(0.0), at));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>& at) const {
    return Rotor::dissipation(whirl(q), whirl(v), shaft(q, v[kSpin], at)) +
           (0.5 * motor.drag) * (v[kSpin] * v[kSpin]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>& v,
                                              const EvaluationPoint<S>& at) const {
    const std::array<S, kSpin> applied = Rotor::force(whirl(q), whirl(v), shaft(q, v[kSpin], at));
    std::array<S, kDof> all;
    for (std::size_t i = 0; i < kSpin; ++i) {
      all[i] = applied[i];
    }
    all[kSpin] = motor.torque(v[kSpin]);
    return all;
  }

  std::vector<Condition> conditions([[maybe_unused]] const std::array<double, kDof>& q,
                                    [[maybe_unused]] const std::array<double, kDof>& v,
                                    [[maybe_unused]] const std::array<double, kDof>& a,
                                    [[maybe_unused]] const EvaluationPoint<double>& at) const {
    if constexpr (HasConditions<Rotor>::value) {
      return Rotor::conditions(whirl(q), whirl(v), whirl(a), shaft(q, v[kSpin], at));
    } else {
      return {};
    }
  }

 private:
  template <class S>
  static WHIRL_TWIN_INLINE std::array<S, kSpin> whirl(const std::array<S, kDof>& x) {
    std::array<S, kSpin> head;
    for (std::size_t i = 0; i < kSpin; ++i) {
      head[i] = x[i];
    }
    return head;
  }
  /// The shaft as its own coordinate moves it.
  template <class S>
  static WHIRL_TWIN_INLINE EvaluationPoint<S> shaft(const std::array<S, kDof>& q, const S& speed,
                                                    const EvaluationPoint<S>& at) {
    return {at.time, q[kSpin], speed, S(0.0)};
  }
};

}  // namespace whirl_twin
