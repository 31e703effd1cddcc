// Mass on a spring and a damper: the oscillator of every textbook.
//
//   T = m x'^2 / 2,   V = k x^2 / 2,   D = c x'^2 / 2
//
// x is measured from where the spring is free; nothing acts along it but what is named here.
#pragma once

#include <array>
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

struct MassSpringDamper {
  static constexpr const char* kName = "mass_spring_damper";
  static constexpr const char* kSummary = "mass on a spring and a damper, with or without friction";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = true;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m", "from the free length of the spring, positive in tension"}}};

  double mass = 0.0;            ///< [kg]
  double stiffness = 0.0;       ///< [N/m], of the spring
  double damping = 0.0;         ///< [N s/m], of the damper
  double friction_force = 0.0;  ///< [N], of the form with Coulomb friction; 0 here
  double friction_width = 0.0;  ///< [m/s], of the change of sign of that friction
  double free_length = 0.0;     ///< [m], of the spring; the equations do not need it
  double gravity = 0.0;         ///< [m/s^2], of the scene; it acts across the motion

  static constexpr std::array<Parameter<MassSpringDamper>, 6> parameters() {
    return {
        {{"mass", "kg", Range::kPositive, &MassSpringDamper::mass, "of the body"},
         {"stiffness", "N/m", Range::kNotNegative, &MassSpringDamper::stiffness, "of the spring"},
         {"damping", "N s/m", Range::kNotNegative, &MassSpringDamper::damping, "of the damper",
          0.0},
         {"friction_force", "N", Range::kNotNegative, &MassSpringDamper::friction_force,
          "Coulomb friction between body and ground", 0.0},
         {"friction_width", "m/s", Range::kNotNegative, &MassSpringDamper::friction_width,
          "speed of regularization of that friction; 0: exact, with sticking", 0.0},
         {"free_length", "m", Range::kPositive, &MassSpringDamper::free_length,
          "free length of the spring, from wall to body", 1.0}}};
  }

  double naturalLength() const { return free_length; }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"force", "N", {1.0}, "on the body, along x"},
             {"support", "m", {stiffness}, "of the spring's far end, along x"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    return (0.5 * mass) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return (0.5 * stiffness) * (q[0] * q[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>&) const {
    return {};
  }

  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>&,
                                    const std::array<double, kDof>&,
                                    const EvaluationPoint<double>&) const {
    return {{"spring_length", "m", free_length + q[0], "the spring is compressed to zero length"}};
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    const double l = free_length;
    const double body = 0.36 * l;
    const double floor = -0.5 * body;
    const double left = q[0] - 0.5 * body;
    Sketch s;
    s.size = 2.4 * l;
    s.height = 0.9 * l;
    s.centre = {-0.2 * l, 0.0, 0.1 * l};
    s.boxes = {
        {{-0.2 * l, 0.0, floor - 0.03 * l},
         {2.3 * l, 0.5 * l, 0.06 * l},
         0.0,
         SketchRole::kSupport},
        {{-l - 0.21 * l, 0.0, 0.1 * l}, {0.06 * l, 0.5 * l, 0.68 * l}, 0.0, SketchRole::kSupport},
        {{q[0], 0.0, 0.0}, {body, body, body}, 0.0, SketchRole::kMass}};
    const double wall = -1.18 * l;
    if (stiffness > 0.0) {
      s.springs = {{{wall, 0.0, 0.09 * l}, {left, 0.0, 0.09 * l}, 0.06 * l}};
    }
    if (damping > 0.0) {
      s.dampers = {{{wall, 0.0, -0.08 * l}, {left, 0.0, -0.08 * l}, 0.05 * l}};
    }
    s.tracer = {q[0], 0.0, 0.0};
    return s;
  }
};

// The mass on a spring and a damper with Coulomb friction on the ground.
//
//   D = c x'^2 / 2 + F |x'|
//
// A free swing loses 4 F / k in every turn and ends where |x| <= F / k, held for good
// (dry_friction.h). A `friction_width` w > 0 rounds the change of sign off, D = F sqrt(x'^2 + w^2):
// a body that would stick then creeps, with the rate k w / F, and is damped at F / (m w), which an
// explicit step has to resolve.

struct RubbingMassSpringDamper : MassSpringDamper {
  static constexpr bool kLinear = false;

  static constexpr std::array<Parameter<RubbingMassSpringDamper>, 6> parameters() {
    return inherited<RubbingMassSpringDamper>(MassSpringDamper::parameters());
  }

  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]) + dryDissipation(friction_force, friction_width, v[0]);
  }
  DryContacts<kDof> dryContacts() const {
    DryContacts<kDof> contacts;
    contacts.add({"on the ground", "N", {1.0}, friction_force}, friction_width);
    return contacts;
  }
};

}  // namespace whirl_twin
