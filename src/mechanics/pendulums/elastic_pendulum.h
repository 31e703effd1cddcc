// Elastic pendulum: a mass that swings on a spring.
//
//   T = m (r'^2 + r^2 theta'^2) / 2,   V = k (r - r0)^2 / 2 - m g r cos(theta),   D = c r'^2 / 2
//
// It hangs at l = r0 + m g / k, bounces there at sqrt(k / m) and swings at sqrt(g / l). Where the
// bounce is twice as fast as the swing, k / m = 4 g / l, each feeds the other (A. Vitt and
// G. Gorelik, Zh. Tekh. Fiz. 3, 1933).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/reaction.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct ElasticPendulum {
  static constexpr const char* kName = "elastic_pendulum";
  static constexpr const char* kSummary = "mass that swings on a spring";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"r", "m", "from the pivot to the mass, > 0"},
       {"theta", "rad", "of the spring, from hanging, the mass to the right"}}};

  double mass = 0.0;         ///< [kg]
  double stiffness = 0.0;    ///< [N/m], of the spring
  double free_length = 0.0;  ///< [m], of the spring, from the pivot
  double damping = 0.0;      ///< [N s/m], along the spring
  double gravity = 0.0;      ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<ElasticPendulum>, 4> parameters() {
    return {{{"mass", "kg", Range::kPositive, &ElasticPendulum::mass, "of the bob"},
             {"stiffness", "N/m", Range::kPositive, &ElasticPendulum::stiffness, "of the spring"},
             {"free_length", "m", Range::kNotNegative, &ElasticPendulum::free_length,
              "of the spring, from the pivot"},
             {"damping", "N s/m", Range::kNotNegative, &ElasticPendulum::damping,
              "viscous, along the spring", 0.0}}};
  }

  /// How far from the pivot it hangs.
  double naturalLength() const { return free_length + mass * gravity / stiffness; }

  std::string singularMass() const { return "a mass at the pivot has no inertia against rotation"; }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"force", "N", {1.0, 0.0}, "on the bob, outwards along the spring"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    const S around = q[0] * v[1];
    return (0.5 * mass) * (v[0] * v[0] + around * around);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    const S stretch = q[0] - free_length;
    return (0.5 * stiffness) * (stretch * stretch) - (mass * gravity) * (q[0] * cos(q[1]));
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
    return {{"spring_length", "m", q[0], "the mass has passed the pivot"}};
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    const double reach = naturalLength();
    Sketch s;
    s.size = 2.6 * reach;
    s.height = 2.0 * reach;
    s.centre.z = -0.7 * reach;
    const SketchPoint bob = hangingPoint({}, q[0], q[1]);
    addPin(s, {});
    s.springs = {{{}, bob, 0.05 * reach}};
    s.balls = {{bob, 0.09 * reach, SketchRole::kMass}};
    s.tracer = bob;
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
