// Sprung cart with a rod hinged on it, driven by a force at the rod's free end or by its support
// (lecture notes, "spring-mounted cart with rod pendulum"; errata E09).
//
//   T = (m1 + m2) x'^2 / 2 + m2 l x' theta' cos(theta) / 2 + m2 l^2 theta'^2 / 6
//   V = k (x - y(t))^2 / 2 + m2 g (l/2) (1 - cos theta),     y = Y sin(Omega t)
//   D = c x'^2 / 2 + R |x'|,   Q = F cos(Omega t) (1, l cos theta)    horizontal, at the rod's tip
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/dry_friction.h"
#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct CartPendulum {
  static constexpr const char* kName = "cart_pendulum";
  static constexpr const char* kSummary =
      "sprung cart with a hinged rod, force at the tip or moving support";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m", "of the cart, to the right from the free length of the spring"},
       {"theta", "rad", "of the rod, from hanging, its end to the right"}}};

  double cart_mass = 0.0;          ///< [kg], of the cart
  double rod_mass = 0.0;           ///< [kg], of the uniform rod
  double rod_length = 0.0;         ///< [m], of the rod
  double stiffness = 0.0;          ///< [N/m], of the spring
  double damping = 0.0;            ///< [N s/m], of the cart
  double force_amplitude = 0.0;    ///< [N], at the rod's tip
  double force_frequency = 0.0;    ///< [rad/s], of that force
  double support_amplitude = 0.0;  ///< [m], of the support's motion
  double support_frequency = 0.0;  ///< [rad/s], of that motion
  double friction_force = 0.0;     ///< [N], Coulomb friction on the track
  double friction_width = 0.0;     ///< [m/s], within which it is rounded off; 0: it can hold
  double gravity = 0.0;            ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<CartPendulum>, 11> parameters() {
    return {{{"cart_mass", "kg", Range::kPositive, &CartPendulum::cart_mass, "of the cart"},
             {"rod_mass", "kg", Range::kPositive, &CartPendulum::rod_mass, "of the uniform rod"},
             {"rod_length", "m", Range::kPositive, &CartPendulum::rod_length, "of the rod"},
             {"stiffness", "N/m", Range::kNotNegative, &CartPendulum::stiffness, "of the spring"},
             {"damping", "N s/m", Range::kNotNegative, &CartPendulum::damping, "of the cart", 0.0},
             {"force_amplitude", "N", Range::kAny, &CartPendulum::force_amplitude,
              "at the rod's tip", 0.0},
             {"force_frequency", "rad/s", Range::kNotNegative, &CartPendulum::force_frequency,
              "of that force", 0.0},
             {"support_amplitude", "m", Range::kAny, &CartPendulum::support_amplitude,
              "of the support's motion", 0.0},
             {"support_frequency", "rad/s", Range::kNotNegative, &CartPendulum::support_frequency,
              "of that motion", 0.0},
             {"friction_force", "N", Range::kNotNegative, &CartPendulum::friction_force,
              "Coulomb friction between cart and track", 0.0},
             {"friction_width", "m/s", Range::kNotNegative, &CartPendulum::friction_width,
              "speed of regularization of that friction; 0: exact, with sticking", 0.0}}};
  }

  double naturalLength() const { return rod_length; }

  CartPendulum atMeanLoad() const {
    CartPendulum mean = *this;
    mean.force_amplitude = force_frequency == 0.0 ? force_amplitude : 0.0;
    mean.support_amplitude = 0.0;
    return mean;
  }
  std::vector<double> loadFrequencies() const {
    std::vector<double> all;
    if (force_amplitude != 0.0 && force_frequency != 0.0) {
      all.push_back(force_frequency);
    }
    if (support_amplitude != 0.0 && support_frequency != 0.0) {
      all.push_back(support_frequency);
    }
    return all;
  }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"force", "N", {1.0, 0.0}, "on the cart, along x"},
             {"support", "m", {stiffness, 0.0}, "of the spring's far end, along x"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    return (0.5 * (cart_mass + rod_mass)) * (v[0] * v[0]) +
           (0.5 * rod_mass * rod_length) * (cos(q[1]) * (v[0] * v[1])) +
           (rod_mass * rod_length * rod_length / 6.0) * (v[1] * v[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>& at) const {
    const S stretch = q[0] - support_amplitude * sin(support_frequency * at.time);
    return (0.5 * stiffness) * (stretch * stretch) +
           (0.5 * rod_mass * gravity * rod_length) * (1.0 - cos(q[1]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    S d = (0.5 * damping) * (v[0] * v[0]);
    if (friction_force != 0.0) {
      d = d + dryDissipation(friction_force, friction_width, v[0]);
    }
    return d;
  }
  DryContacts<kDof> dryContacts() const {
    DryContacts<kDof> contacts;
    contacts.add({"on the track", "N", {1.0, 0.0}, friction_force}, friction_width);
    return contacts;
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>& at) const {
    const S f = force_amplitude * cos(force_frequency * at.time);
    return {f, rod_length * (f * cos(q[1]))};
  }

  /// The arrows show the support's motion and the force, each as a part of its amplitude.
  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>& at) const {
    const double l = rod_length;
    const double behind = 0.08 * l;  // the cart runs behind its rod
    const double track = -0.17 * l;
    const double wheel = 0.05 * l;
    const double shaking = std::sin(support_frequency * at.time);
    const double wall = -1.05 * l + support_amplitude * shaking;
    Sketch s;
    s.size = 2.4 * l;
    s.height = 1.6 * l;
    s.centre.z = -0.4 * l;
    const SketchPoint hinge{q[0], 0.0, 0.0};
    const SketchPoint tip = hangingPoint(hinge, l, q[1]);
    s.boxes = {
        {{0.0, behind, track - 0.02 * l}, {2.3 * l, 0.16 * l, 0.04 * l}, 0.0, SketchRole::kSupport},
        {{q[0], behind, 0.0}, {0.4 * l, 0.1 * l, 0.16 * l}, 0.0, SketchRole::kMass}};
    for (const double side : {-0.12 * l, 0.12 * l}) {
      s.discs.push_back({{q[0] + side, behind, track + wheel},
                         {0.0, 1.0, 0.0},
                         wheel,
                         0.13 * l,
                         q[0] / wheel,
                         SketchRole::kBody});
    }
    s.rods = {{hinge, tip, 0.022 * l, SketchRole::kBody},
              {{q[0], behind, 0.0}, {q[0], -0.04 * l, 0.0}, 0.03 * l, SketchRole::kSupport}};
    if (stiffness > 0.0) {  // without a spring there is no wall to hold it
      s.boxes.push_back({{wall - 0.04 * l, behind, 0.02 * l},
                         {0.08 * l, 0.16 * l, 0.34 * l},
                         0.0,
                         SketchRole::kSupport});
      s.springs = {{{wall, behind, 0.0}, {q[0] - 0.2 * l, behind, 0.0}, 0.05 * l}};
    }
    const double push = force_amplitude == 0.0 ? 0.0 : std::cos(force_frequency * at.time);
    const double shake = support_amplitude == 0.0 ? 0.0 : shaking;
    s.arrows = {
        {tip, {tip.x + std::copysign(0.35 * l, force_amplitude) * push, 0.0, tip.z}},
        {{-1.05 * l, behind, 0.28 * l},
         {-1.05 * l + std::copysign(0.35 * l, support_amplitude) * shake, behind, 0.28 * l}}};
    s.tracer = tip;
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
