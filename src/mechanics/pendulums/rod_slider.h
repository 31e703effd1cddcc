// Rod swinging about its end with a mass that slides on it against a spring (lecture notes, "rod
// with sliding mass"; errata E08).
//
//   T = m0 (r'^2 + r^2 theta'^2) / 2 + m l^2 theta'^2 / 6
//   V = k (r - r0)^2 / 2 - m0 g r cos(theta) - m g (l/2) cos(theta)
#pragma once

#include <algorithm>
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

struct RodSlider {
  static constexpr const char* kName = "rod_slider";
  static constexpr const char* kSummary = "swinging rod with a mass sliding on it against a spring";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"r", "m", "from the pivot to the slider, > 0"},
       {"theta", "rad", "of the rod, from hanging, its end to the right"}}};

  double slider_mass = 0.0;  ///< [kg], of the slider
  double rod_mass = 0.0;     ///< [kg], of the uniform rod
  double rod_length = 0.0;   ///< [m], of the rod
  double stiffness = 0.0;    ///< [N/m], of the spring
  double free_length = 0.0;  ///< [m], of the spring, from the pivot
  double gravity = 0.0;      ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<RodSlider>, 5> parameters() {
    return {{{"slider_mass", "kg", Range::kPositive, &RodSlider::slider_mass, "of the slider"},
             {"rod_mass", "kg", Range::kNotNegative, &RodSlider::rod_mass, "of the uniform rod"},
             {"rod_length", "m", Range::kPositive, &RodSlider::rod_length, "of the rod"},
             {"stiffness", "N/m", Range::kPositive, &RodSlider::stiffness, "of the spring"},
             {"free_length", "m", Range::kNotNegative, &RodSlider::free_length,
              "of the spring, from the pivot"}}};
  }

  /// The rod's, or how far from the pivot the slider can rest.
  double naturalLength() const {
    return std::max(rod_length, free_length + slider_mass * gravity / stiffness);
  }

  std::string singularMass() const {
    return rod_mass == 0.0 ? "a massless rod has no inertia while the slider is at the pivot" : "";
  }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"force", "N", {1.0, 0.0}, "on the slider, outwards along the rod"},
             {"torque", "N m", {0.0, 1.0}, "at the pivot, on the rod"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    const S around = q[0] * v[1];
    return (0.5 * slider_mass) * (v[0] * v[0] + around * around) +
           (rod_mass * rod_length * rod_length / 6.0) * (v[1] * v[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    const S stretch = q[0] - free_length;
    return (0.5 * stiffness) * (stretch * stretch) -
           gravity * ((slider_mass * q[0] + 0.5 * rod_mass * rod_length) * cos(q[1]));
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

  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>&,
                                    const std::array<double, kDof>&,
                                    const EvaluationPoint<double>&) const {
    return {{"rod_end", "m", std::min(q[0], rod_length - q[0]),
             q[0] > 0.0 ? "the slider has left the rod at its end"
                        : "the slider has passed the pivot"}};
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    const double reach = naturalLength();
    Sketch s;
    s.size = 2.3 * reach;
    s.height = 1.6 * reach;
    s.centre.z = -0.4 * reach;
    const SketchPoint slider = hangingPoint({}, q[0], q[1]);
    s.rods = {{{}, hangingPoint({}, rod_length, q[1]), 0.016 * reach, SketchRole::kBody}};
    addPin(s, {});
    s.springs = {{{}, hangingPoint({}, q[0] - 0.09 * reach, q[1]), 0.04 * reach}};
    s.boxes = {{slider, {0.13 * reach, 0.13 * reach, 0.18 * reach}, q[1], SketchRole::kMass}};
    s.tracer = slider;
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
