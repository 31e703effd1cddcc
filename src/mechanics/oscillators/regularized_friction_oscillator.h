// The plank on two rollers with Coulomb friction rounded off, so that it sticks by creeping.
//
//   T = m x'^2 / 2,   Q = t1 R1 + t2 R2
//   t1 = mu tanh((vs - x') / eps),   t2 = -mu tanh((vs + x') / eps)
//   R1 + R2 = m g,   R1 - R2 = m g [h (t1 + t2) / 2 - x] / [a - h (t1 - t2) / 2]
//
// Regularised is the jump of the friction force where the slip changes sign: it becomes a slope of
// width eps (`regularization`). There the plank is damped at the rate mu g a / (eps (a - mu h)) at
// most: an explicit step has to stay below about twice the inverse of that to be stable, a tenth of
// it to be accurate. A plank that sticks to a roller does so by creeping against it, at a slip of
// eps atanh(F / (mu R)), F the friction force it takes to hold it: eps is the error of the sticking
// velocity. With larger amplitudes than vs / p one roller sticks until they have fallen to that.
#pragma once

#include "mechanics/oscillators/friction_oscillator.h"

namespace whirl_twin {

struct RegularizedFrictionOscillator : FrictionOscillator {
  static constexpr bool kLinear = false;

  static constexpr std::array<Parameter<RegularizedFrictionOscillator>, 6> parameters() {
    return inherited<RegularizedFrictionOscillator>(FrictionOscillator::parameters());
  }

  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>&, const Moment<S>&) const {
    return {};
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>& v,
                                              const Moment<S>&) const {
    const S t1 = leftFriction(v[0]);
    const S t2 = rightFriction(v[0]);
    const Normals<S> r = normalForces(q[0], t1, t2);
    return {t1 * r.left + t2 * r.right};
  }

  std::vector<Reaction> reactions(const std::array<double, kDof>& q,
                                  const std::array<double, kDof>& v,
                                  const std::array<double, kDof>&, const Moment<double>&) const {
    return named(normalForces(q[0], leftFriction(v[0]), rightFriction(v[0])));
  }
  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>& v,
                                    const std::array<double, kDof>&, const Moment<double>&) const {
    const double t1 = leftFriction(v[0]);
    const double t2 = rightFriction(v[0]);
    return {contact(normalForces(q[0], t1, t2)), noTipping(0.5 * (t1 - t2))};
  }

 private:
  template <class S>
  WHIRL_TWIN_INLINE S leftFriction(const S& rate) const {
    return friction_coefficient * tanh((1.0 / regularization) * (roller_speed - rate));
  }
  template <class S>
  WHIRL_TWIN_INLINE S rightFriction(const S& rate) const {
    return -friction_coefficient * tanh((1.0 / regularization) * (roller_speed + rate));
  }
};

}  // namespace whirl_twin
