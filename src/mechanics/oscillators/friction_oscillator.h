// Plank lying on two rollers 2a apart that turn against each other: friction drives it to and fro
// and so measures its coefficient (lecture notes, "friction testing"; errata E33, E34). This form
// is exact Coulomb friction while the plank slides on both rollers.
//
//   T = m x'^2 / 2,   V = K x^2 / 2,   K = mu m g / (a - mu h)
//
// from R1 + R2 = m g and the moments about the mass centre, h above the contacts: R1 - R2 = -m g x
// / (a - mu h), Q = mu (R1 - R2) = -K x. Friction of constant direction is a function of the
// position alone, so it has a potential and m x'^2 / 2 + K x^2 / 2 is conserved, although nothing
// stores that energy: the rollers' drives give and take it. Rollers that turn outwards
// (roller_speed < 0) have mu -> -mu and drive the plank away. Rollers at rest (roller_speed = 0)
// leave no direction of sliding: no friction here, and `sliding` is violated.
//
// Any step that resolves sqrt(K/m) will do. Sticking is not modelled: where |x'| reaches
// |roller_speed| the condition `sliding` is violated and the computed motion continues as if the
// plank still slid; StickingFrictionOscillator is the form that sticks. Likewise a plank that
// has left a roller (`contact`) or tips over it (`no_tipping`: a < mu h, K < 0) is computed on.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/dry_friction.h"
#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/reaction.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct FrictionOscillator {
  static constexpr const char* kName = "friction_oscillator";
  static constexpr const char* kSummary = "plank on two counter-rotating rollers";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = true;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m", "of the mass centre, to the right from midway between the rollers"}}};

  double mass = 0.0;                  ///< [kg], of the plank
  double friction_coefficient = 0.0;  ///< [-], mu
  double half_spacing = 0.0;          ///< [m], a: from each roller to midspan
  double height = 0.0;                ///< [m], h: of the mass centre above the contacts
  double roller_speed = 0.0;          ///< [m/s], of the rims; > 0: the tops move inwards
  double regularization = 0.0;        ///< [m/s], of the form that can stick; 0 here
  double gravity = 0.0;               ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<FrictionOscillator>, 6> parameters() {
    return {{{"mass", "kg", Range::kPositive, &FrictionOscillator::mass, "of the plank"},
             {"friction_coefficient", "-", Range::kNotNegative,
              &FrictionOscillator::friction_coefficient, "between plank and rollers"},
             {"half_spacing", "m", Range::kPositive, &FrictionOscillator::half_spacing,
              "from each roller to midspan"},
             {"height", "m", Range::kNotNegative, &FrictionOscillator::height,
              "of the plank's mass centre above the contacts"},
             {"roller_speed", "m/s", Range::kAny, &FrictionOscillator::roller_speed,
              "of the rollers' rims; > 0: tops move inwards, < 0: outwards"},
             {"regularization", "m/s", Range::kNotNegative, &FrictionOscillator::regularization,
              "width of the regularization of the friction law; 0: exact", 0.0}}};
  }

  double naturalLength() const { return half_spacing; }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"force", "N", {1.0}, "on the plank, along x"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    return (0.5 * mass) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    const double mu = slidingFriction();
    return (0.5 * mu * mass * gravity / (half_spacing - mu * height)) * (q[0] * q[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>&,
                                  const EvaluationPoint<S>&) const {
    return {};
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>&) const {
    return {};
  }

  std::vector<Reaction> reactions(const std::array<double, kDof>& q,
                                  const std::array<double, kDof>&, const std::array<double, kDof>&,
                                  const EvaluationPoint<double>&) const {
    return named(normalForces<double>(q[0], slidingFriction(), -slidingFriction()));
  }
  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>& v,
                                    const std::array<double, kDof>&,
                                    const EvaluationPoint<double>&) const {
    const double mu = slidingFriction();
    return {contact(normalForces<double>(q[0], mu, -mu)),
            noTipping(mu),
            {"sliding", "m/s", std::abs(roller_speed) - std::abs(v[0]),
             "the plank is as fast as a roller and would stick to it"}};
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>& at) const {
    const double a = half_spacing;
    const double roller = 0.35 * a;
    const double turned = roller_speed * at.time / roller;  // right-handed about y: tops towards +x
    const double thickness = height > 0.0 ? 2.0 * height : 0.05 * a;
    Sketch s;
    s.size = 6.5 * a;
    s.height = 2.0 * a + thickness;
    s.centre.z = 0.5 * thickness;
    for (const double side : {-1.0, 1.0}) {
      const SketchPoint centre{side * a, 0.0, -roller};
      s.discs.push_back(
          {centre, {0.0, 1.0, 0.0}, roller, 0.6 * a, -side * turned, SketchRole::kSupport});
    }
    s.boxes.push_back(
        {{q[0], 0.0, 0.5 * thickness}, {4.0 * a, 0.5 * a, thickness}, 0.0, SketchRole::kBody});
    s.balls.push_back({{q[0], 0.0, height}, 0.06 * a, SketchRole::kMark});
    s.tracer = {q[0], 0.0, height};
    return s;
  }

 protected:
  template <class S>
  struct Normals {
    S left, right;  // [N], R1 and R2
  };

  /// Normal forces with the friction coefficients t1, t2 at the left and the right roller, positive
  /// where friction pushes the plank towards +x.
  template <class S>
  WHIRL_TWIN_INLINE Normals<S> normalForces(const S& x, const S& t1, const S& t2) const {
    const S difference = (mass * gravity) * ((0.5 * height) * (t1 + t2) - x) /
                         (half_spacing - (0.5 * height) * (t1 - t2));
    return {0.5 * (mass * gravity + difference), 0.5 * (mass * gravity - difference)};
  }
  static std::vector<Reaction> named(const Normals<double>& r) {
    return {{"normal_force_left", "N", r.left}, {"normal_force_right", "N", r.right}};
  }
  static Condition contact(const Normals<double>& r) {
    return {"contact", "N", std::min(r.left, r.right), "the plank lifts off a roller"};
  }
  /// mu > 0 where the rollers turn inwards.
  Condition noTipping(double mu) const {
    return {"no_tipping", "m", half_spacing - mu * height,
            "friction tips the plank: its mass centre is too high for the spacing"};
  }

 private:
  /// mu, negative where the rollers turn outwards.
  double slidingFriction() const {
    return roller_speed == 0.0 ? 0.0 : std::copysign(friction_coefficient, roller_speed);
  }
};

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

struct RegularizedFrictionOscillator : FrictionOscillator {
  static constexpr bool kLinear = false;

  static constexpr std::array<Parameter<RegularizedFrictionOscillator>, 6> parameters() {
    return inherited<RegularizedFrictionOscillator>(FrictionOscillator::parameters());
  }

  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>&, const EvaluationPoint<S>&) const {
    return {};
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>& v,
                                              const EvaluationPoint<S>&) const {
    const S t1 = leftFriction(v[0]);
    const S t2 = rightFriction(v[0]);
    const Normals<S> r = normalForces(q[0], t1, t2);
    return {t1 * r.left + t2 * r.right};
  }

  std::vector<Reaction> reactions(const std::array<double, kDof>& q,
                                  const std::array<double, kDof>& v,
                                  const std::array<double, kDof>&,
                                  const EvaluationPoint<double>&) const {
    return named(normalForces(q[0], leftFriction(v[0]), rightFriction(v[0])));
  }
  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>& v,
                                    const std::array<double, kDof>&,
                                    const EvaluationPoint<double>&) const {
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

// The plank on two rollers with exact Coulomb friction: it slides on both, or one roller carries it
// along (dry_friction.h).
//
//   T = m x'^2 / 2,   Q = t1 R1 + t2 R2,   t1 = -mu s1,   t2 = -mu s2
//   w1 = x' - vs,  w2 = x' + vs           sliding on the left and the right roller
//   R1 + R2 = m g,   R1 - R2 = m g [h (t1 + t2) / 2 - x] / [a - h (t1 - t2) / 2]
//
// With larger amplitudes than vs / p one roller holds the plank, at vs, until the other's friction
// exceeds what it has; the amplitude is vs / p from then on, and the plank slides on both. Rollers
// at rest (roller_speed = 0) act as a fixed surface: one contact, that of the left roller.

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
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>&, const EvaluationPoint<S>&) const {
    return {};
  }
  /// At full friction wherever it slides.
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>& v,
                                              const EvaluationPoint<S>&) const {
    return {total(q[0], slidingShares(v[0]))};
  }

  std::vector<Reaction> reactions(const std::array<double, kDof>& q,
                                  const std::array<double, kDof>& v,
                                  const std::array<double, kDof>& a,
                                  const EvaluationPoint<double>&) const {
    return named(normals(q[0], v[0], a[0]));
  }
  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>& v,
                                    const std::array<double, kDof>& a,
                                    const EvaluationPoint<double>&) const {
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
