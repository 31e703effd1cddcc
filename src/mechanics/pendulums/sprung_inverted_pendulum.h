// Inverted pendulum held upright by a horizontal spring (lecture notes, "spring-held inverted
// pendulum"; errata E35, E36). theta is measured from upright.
//
//   T = m L^2 theta'^2 / 2,   V = k (L sin theta)^2 / 2 - m g L (1 - cos theta)
//   D = c (L theta')^2 / 2
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

struct SprungInvertedPendulum {
  static constexpr const char* kName = "sprung_inverted_pendulum";
  static constexpr const char* kSummary = "inverted pendulum supported by a horizontal spring";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta", "rad", "from upright, the bob to the right"}}};

  double mass = 0.0;       ///< [kg], of the bob
  double length = 0.0;     ///< [m], pivot to bob and spring
  double stiffness = 0.0;  ///< [N/m], of the spring
  double damping = 0.0;    ///< [N s/m], of a dashpot at the bob
  double gravity = 0.0;    ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<SprungInvertedPendulum>, 4> parameters() {
    return {{{"mass", "kg", Range::kPositive, &SprungInvertedPendulum::mass, "of the bob"},
             {"length", "m", Range::kPositive, &SprungInvertedPendulum::length,
              "pivot to bob and spring"},
             {"stiffness", "N/m", Range::kNotNegative, &SprungInvertedPendulum::stiffness,
              "of the spring"},
             {"damping", "N s/m", Range::kNotNegative, &SprungInvertedPendulum::damping,
              "of a dashpot at the bob", 0.0}}};
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {1.0}, "at the pivot, on the pendulum"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    return (0.5 * mass * length * length) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    const S aside = sin(q[0]);
    return (0.5 * stiffness * length * length) * (aside * aside) -
           (mass * gravity * length) * (1.0 - cos(q[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping * length * length) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>&) const {
    return {};
  }

  /// The spring's far end runs in a guide, so that the spring stays level.
  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    Sketch s;
    s.size = 2.6 * length;
    s.height = 2.5 * length;
    const SketchPoint bob{length * std::sin(q[0]), 0.0, length * std::cos(q[0])};
    const double guide = -1.2 * length;
    const double bob_radius = 0.09 * length;
    s.rods = {{{}, bob, 0.02 * length, SketchRole::kBody}};
    addPin(s, {});
    s.balls = {{bob, bob_radius, SketchRole::kMass}};
    if (stiffness > 0.0) {
      s.rods.push_back({{guide, 0.0, -1.15 * length},
                        {guide, 0.0, 1.15 * length},
                        0.02 * length,
                        SketchRole::kSupport});
      s.boxes = {{{guide, 0.0, bob.z},
                  {0.1 * length, 0.1 * length, 0.12 * length},
                  0.0,
                  SketchRole::kBody}};
      s.springs = {{{guide, 0.0, bob.z}, {bob.x - bob_radius, 0.0, bob.z}, 0.05 * length}};
    }
    s.tracer = bob;
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
