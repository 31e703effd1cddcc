// The plank on two rollers with exact Coulomb friction: it slides on both, or one roller carries it
// along (dry_friction.h).
//
//   T = m x'^2 / 2,   Q = t1 R1 + t2 R2,   t1 = -mu s1,   t2 = -mu s2
//   w1 = x' - vs,  w2 = x' + vs           sliding on the left and the right roller
//   R1 + R2 = m g,   R1 - R2 = m g [h (t1 + t2) / 2 - x] / [a - h (t1 - t2) / 2]
//
// With larger amplitudes than vs / p one roller holds the plank, at vs, until the other's friction
// exceeds what it has; the amplitude is vs / p from then on, and the plank slides on both. Rollers
// at rest (roller_speed = 0) are a floor: one contact, that of the left roller.
#pragma once

#include "mechanics/dry_friction.h"
#include "mechanics/oscillators/friction_oscillator.h"

namespace whirl_twin {

struct StickingFrictionOscillator : FrictionOscillator {
  static constexpr bool kLinear = false;

  static constexpr std::array<Parameter<StickingFrictionOscillator>, 6> parameters() {
    return inherited<StickingFrictionOscillator>(FrictionOscillator::parameters());
  }

  DryContacts<kDof> dryContacts() const {
    DryContacts<kDof> contacts;
    contacts.add({roller_speed == 0.0 ? "on the rollers" : "on the left roller",
                  "-",
                  {1.0},
                  friction_coefficient,
                  roller_speed},
                 0.0);
    if (roller_speed != 0.0) {
      contacts.add({"on the right roller", "-", {1.0}, friction_coefficient, -roller_speed}, 0.0);
    }
    return contacts;
  }
  std::array<double, kDof> dryFriction(const std::array<double, kDof>& q,
                                       const ContactNumbers& share) const {
    return {total(q[0], share)};
  }

  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>&, const Moment<S>&) const {
    return {};
  }
  /// At full friction wherever it slides.
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>& v,
                                              const Moment<S>&) const {
    return {total(q[0], slidingShares(v[0]))};
  }

  std::vector<Reaction> reactions(const std::array<double, kDof>& q,
                                  const std::array<double, kDof>& v,
                                  const std::array<double, kDof>& a, const Moment<double>&) const {
    return named(normals(q[0], v[0], a[0]));
  }
  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>& v,
                                    const std::array<double, kDof>& a,
                                    const Moment<double>&) const {
    const ContactNumbers share = slidingShares(v[0]);
    return {contact(normals(q[0], v[0], a[0])),
            noTipping(0.5 * friction_coefficient * (right(share) - share[0]))};
  }

 private:
  double right(const ContactNumbers& share) const {
    return roller_speed == 0.0 ? share[0] : share[1];
  }
  template <class S>
  ContactNumbers slidingShares(const S& rate) const {
    const auto sign = [](const S& w) { return w > 0.0 ? 1.0 : w < 0.0 ? -1.0 : 0.0; };
    return {sign(rate - roller_speed), sign(rate + roller_speed)};
  }
  template <class S>
  S total(const S& x, const ContactNumbers& share) const {
    const S t1(-friction_coefficient * share[0]);
    const S t2(-friction_coefficient * right(share));
    const Normals<S> r = normalForces(x, t1, t2);
    return t1 * r.left + t2 * r.right;
  }
  /// While a roller holds the plank its friction is known by the acceleration alone, from the
  /// moments about the mass centre: a (R1 - R2) = h m x'' - m g x, if nothing else acts.
  Normals<double> normals(double x, double rate, double acceleration) const {
    const ContactNumbers share = slidingShares(rate);
    if (share[0] != 0.0 && right(share) != 0.0) {
      return normalForces<double>(x, -friction_coefficient * share[0],
                                  -friction_coefficient * right(share));
    }
    const double difference = mass * (height * acceleration - gravity * x) / half_spacing;
    return {0.5 * (mass * gravity + difference), 0.5 * (mass * gravity - difference)};
  }
};

}  // namespace whirl_twin
