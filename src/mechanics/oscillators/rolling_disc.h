// Disc rolling without slip between a spring and a damper at its centre, with a point mass off its
// centre if wanted (lecture notes, "rolling disc" and "rolling disc with off-centre mass";
// E05-E07).
//
//   T = x'^2 / 2 [M + J/r^2 + m (1 + l^2/r^2 - (2 l/r) cos(x/r))]
//   V = k x^2 / 2 + m g l (1 - cos(x/r)),   D = c x'^2 / 2       the mass below the centre at x = 0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/reaction.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct RollingDisc {
  static constexpr const char* kName = "rolling_disc";
  static constexpr const char* kSummary =
      "disc rolling against a spring and damper, with an off-centre mass";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m",
        "of the centre, to the right from the free length of the spring, with the point mass "
        "below"}}};

  double disc_mass = 0.0;             ///< [kg], of the disc
  double disc_inertia = 0.0;          ///< [kg m^2], about its centre
  double radius = 0.0;                ///< [m], of the disc
  double stiffness = 0.0;             ///< [N/m], of the spring
  double damping = 0.0;               ///< [N s/m], of the damper
  double offset_mass = 0.0;           ///< [kg], point mass on the disc
  double offset = 0.0;                ///< [m], distance of the point mass below the centre at x = 0
  double friction_coefficient = 0.0;  ///< [-], of the plane; the equations do not need it
  double gravity = 0.0;               ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<RollingDisc>, 8> parameters() {
    return {{{"disc_mass", "kg", Range::kPositive, &RollingDisc::disc_mass, "of the disc"},
             {"disc_inertia", "kg m^2", Range::kNotNegative, &RollingDisc::disc_inertia,
              "about its centre"},
             {"radius", "m", Range::kPositive, &RollingDisc::radius, "of the disc"},
             {"stiffness", "N/m", Range::kNotNegative, &RollingDisc::stiffness, "of the spring"},
             {"damping", "N s/m", Range::kNotNegative, &RollingDisc::damping, "of the damper", 0.0},
             {"offset_mass", "kg", Range::kNotNegative, &RollingDisc::offset_mass,
              "point mass on the disc", 0.0},
             {"offset", "m", Range::kNotNegative, &RollingDisc::offset,
              "distance of the point mass below the centre at x = 0", 0.0},
             {"friction_coefficient", "-", Range::kNotNegative, &RollingDisc::friction_coefficient,
              "static friction of the plane, to detect slip; 0: not checked", 0.0}}};
  }

  /// The radius: the distance between its equilibria is of the order of a radian of rolling.
  double naturalLength() const { return radius; }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"force", "N", {1.0}, "on the disc's centre, along x"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    const double ratio = offset / radius;
    return (0.5 * (disc_mass + disc_inertia / (radius * radius))) * (v[0] * v[0]) +
           (0.5 * offset_mass) *
               ((1.0 + ratio * ratio - 2.0 * ratio * cos((1.0 / radius) * q[0])) * (v[0] * v[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return (0.5 * stiffness) * (q[0] * q[0]) +
           (offset_mass * gravity * offset) * (1.0 - cos((1.0 / radius) * q[0]));
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

  /// `normal_force` up and `friction_force` along +x, both of the plane on the disc, by Newton's
  /// law on the disc and its off-centre mass.
  std::vector<Reaction> reactions(const std::array<double, kDof>& q,
                                  const std::array<double, kDof>& v,
                                  const std::array<double, kDof>& a,
                                  const EvaluationPoint<double>&) const {
    const double turn = q[0] / radius;
    const double rate = v[0] / radius;
    const double spin_up = a[0] / radius;
    const double along = a[0] - offset * (spin_up * std::cos(turn) - rate * rate * std::sin(turn));
    const double up = offset * (spin_up * std::sin(turn) + rate * rate * std::cos(turn));
    return {{"normal_force", "N", (disc_mass + offset_mass) * gravity + offset_mass * up},
            {"friction_force", "N",
             disc_mass * a[0] + offset_mass * along + stiffness * q[0] + damping * v[0]}};
  }
  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>& v,
                                    const std::array<double, kDof>& a,
                                    const EvaluationPoint<double>& at) const {
    const std::vector<Reaction> plane = reactions(q, v, a, at);
    std::vector<Condition> all{{"contact", "N", plane[0].value, "the disc lifts off its plane"}};
    if (friction_coefficient > 0.0) {
      all.push_back({"no_slip", "N",
                     friction_coefficient * plane[0].value - std::fabs(plane[1].value),
                     "the disc slips on its plane"});
    }
    return all;
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    const double r = radius;
    const double wall = 3.4 * r;
    const double behind = 0.28 * r;  // spring and damper run behind the disc
    const double turn = q[0] / r;
    Sketch s;
    s.size = 7.4 * r;
    s.height = 3.0 * r;
    s.centre.z = 0.3 * r;
    s.discs = {{{q[0], 0.0, 0.0}, {0.0, 1.0, 0.0}, r, 0.25 * r, turn, SketchRole::kMass}};
    s.rods = {{{q[0], behind, 0.0}, {q[0], -0.2 * r, 0.0}, 0.08 * r, SketchRole::kSupport}};
    s.boxes = {{{0.0, 0.0, -1.05 * r}, {7.2 * r, 0.9 * r, 0.1 * r}, 0.0, SketchRole::kSupport},
               {{-wall - 0.1 * r, behind, -0.3 * r},
                {0.2 * r, 0.3 * r, 1.5 * r},
                0.0,
                SketchRole::kSupport}};
    if (stiffness > 0.0) {
      s.springs = {{{-wall, behind, 0.0}, {q[0], behind, 0.0}, 0.13 * r}};
    }
    if (damping > 0.0) {
      s.boxes.push_back({{wall + 0.1 * r, behind, -0.3 * r},
                         {0.2 * r, 0.3 * r, 1.5 * r},
                         0.0,
                         SketchRole::kSupport});
      s.dampers = {{{wall, behind, 0.0}, {q[0], behind, 0.0}, 0.13 * r}};
    }
    // Without a mass off the centre a point of the rim leaves its cycloid.
    const double marked = offset_mass > 0.0 ? offset : r;
    s.tracer = {q[0] - marked * std::sin(turn), -0.16 * r, -marked * std::cos(turn)};
    s.has_tracer = true;
    if (offset_mass > 0.0) {
      s.balls = {{s.tracer, 0.14 * r, SketchRole::kMark}};
    }
    return s;
  }
};

}  // namespace whirl_twin
