// Two equal bars in a V, hanging from a fixed pin to a roller at the same level, pulled outwards by
// a force (lecture notes, "virtual work"; errata E01): equilibrium at tan(theta) = 2 P / (m g).
//
//   T = m l^2 theta'^2 (1/3 + cos^2 theta),   V = -m g l cos(theta),   Q = 2 P l cos(theta)
//   D = c theta'^2 / 2                          theta of each bar from the vertical
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

struct TwoBarLinkage {
  static constexpr const char* kName = "two_bar_linkage";
  static constexpr const char* kSummary = "two bars in a V from pin to roller, pulled outwards";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta", "rad", "of each bar, from the vertical, the roller outwards"}}};

  double bar_mass = 0.0;    ///< [kg], of each bar
  double bar_length = 0.0;  ///< [m], of each bar
  double pull = 0.0;        ///< [N], on the roller, outwards
  double damping = 0.0;     ///< [N m s/rad], viscous, on theta
  double gravity = 0.0;     ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<TwoBarLinkage>, 4> parameters() {
    return {{{"bar_mass", "kg", Range::kPositive, &TwoBarLinkage::bar_mass, "of each bar"},
             {"bar_length", "m", Range::kPositive, &TwoBarLinkage::bar_length, "of each bar"},
             {"force", "N", Range::kAny, &TwoBarLinkage::pull, "on the roller, outwards"},
             {"damping", "N m s/rad", Range::kNotNegative, &TwoBarLinkage::damping,
              "viscous, on theta", 0.0}}};
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {1.0}, "at the pin, on the first bar"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    const S upright = cos(q[0]);
    return (bar_mass * bar_length * bar_length) * ((1.0 / 3.0 + upright * upright) * (v[0] * v[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return -(bar_mass * gravity * bar_length) * cos(q[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>&) const {
    return {(2.0 * pull * bar_length) * cos(q[0])};
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    const double l = bar_length;
    const double roller = 0.07 * l;
    Sketch s;
    s.size = 2.9 * l;
    s.height = 1.6 * l;
    s.centre = {0.95 * l, 0.0, -0.35 * l};
    const SketchPoint joint = hangingPoint({}, l, q[0]);
    const SketchPoint end{2.0 * joint.x, 0.0, 0.0};
    s.rods = {{{}, joint, 0.03 * l, SketchRole::kBody}, {joint, end, 0.03 * l, SketchRole::kBody}};
    addPin(s, {});
    s.boxes = {{{1.1 * l, 0.12 * l, -roller - 0.02 * l},
                {2.2 * l, 0.12 * l, 0.04 * l},
                0.0,
                SketchRole::kSupport}};
    s.discs = {{{end.x, 0.08 * l, 0.0},
                {0.0, 1.0, 0.0},
                roller,
                0.16 * l,
                end.x / roller,
                SketchRole::kMass}};
    s.balls = {{joint, 0.05 * l, SketchRole::kSupport}};
    const double drawn = pull == 0.0 ? 0.0 : std::copysign(0.35 * l, pull);
    s.arrows = {{end, {end.x + drawn, 0.0, 0.0}}};
    s.tracer = joint;
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
