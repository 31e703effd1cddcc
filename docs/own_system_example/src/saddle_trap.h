// A small ball that slides in a saddle, z = (x^2 - y^2) / (2 R), which a shaft turns about the
// vertical at the speed w. x and y turn with the saddle: x up the two slopes, y down the others.
//
//   T = m [(x' - w y)^2 + (y' + w x)^2 + z'^2] / 2,   z' = (x x' - y y') / R
//   V = m g z cos b + m g (x cos a - y sin a) sin b,  D = c (x'^2 + y'^2 + z'^2) / 2
//
// z = (x^2 - y^2) / (2 R), a the shaft's angle, b by how much its axis leans: seen from the saddle
// the weight then turns.
//
// At rest the ball runs down along y. Turned faster than w^2 = g/R it stays: near the middle it
// moves with the frequencies sqrt(w^2 + g/R) and sqrt(w^2 - g/R). Only inertia holds it, so that
// any friction on the saddle lets it spiral out in the end (the theorem of Thomson and Tait).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/reaction.h"
#include "mechanics/sketch.h"

namespace saddle_trap {

using namespace whirl_twin;

struct SaddleTrap {
  static constexpr const char* kName = "saddle_trap";
  static constexpr const char* kSummary = "ball in a saddle that a shaft turns about the vertical";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = true;
  static constexpr std::array<Coordinate, kDof> kCoordinates{{{"x", "m"}, {"y", "m"}}};

  double mass = 0.0;     ///< [kg]
  double radius = 0.0;   ///< [m], R, of curvature in the middle
  double rim = 0.0;      ///< [m], from the middle to the edge, seen from above
  double damping = 0.0;  ///< [N s/m], viscous, on the saddle
  double lean = 0.0;     ///< [rad], of the axis from the vertical
  double gravity = 0.0;  ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<SaddleTrap>, 5> parameters() {
    return {
        {{"mass", "kg", Range::kPositive, &SaddleTrap::mass, "of the ball"},
         {"radius", "m", Range::kPositive, &SaddleTrap::radius, "of curvature in the middle"},
         {"rim", "m", Range::kPositive, &SaddleTrap::rim, "from the middle to the edge"},
         {"damping", "N s/m", Range::kNotNegative, &SaddleTrap::damping, "viscous, on the saddle",
          0.0},
         {"lean", "rad", Range::kAny, &SaddleTrap::lean, "of the axis from the vertical", 0.0}}};
  }

  double naturalLength() const { return rim; }
  /// Without what turns of the weight.
  SaddleTrap atMeanLoad() const {
    SaddleTrap upright = *this;
    upright.gravity = gravity * cos(lean);
    upright.lean = 0.0;
    return upright;
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>& at) const {
    const S along_x = v[0] - at.speed * q[1];
    const S along_y = v[1] + at.speed * q[0];
    const S up = (1.0 / radius) * (q[0] * v[0] - q[1] * v[1]);
    return (0.5 * mass) * (along_x * along_x + along_y * along_y + up * up);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>& at) const {
    const S up = (0.5 * mass * gravity * cos(lean) / radius) * (q[0] * q[0] - q[1] * q[1]);
    const S aside = q[0] * cos(at.angle) - q[1] * sin(at.angle);
    return up + (mass * gravity * sin(lean)) * aside;
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    const S up = (1.0 / radius) * (q[0] * v[0] - q[1] * v[1]);
    return (0.5 * damping) * (v[0] * v[0] + v[1] * v[1] + up * up);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&, const EvaluationPoint<S>&) const {
    return {};
  }

  /// `normal_force`, of the saddle on the ball, by Newton's law across the surface.
  std::vector<Reaction> reactions(const std::array<double, kDof>& q,
                                  const std::array<double, kDof>& v,
                                  const std::array<double, kDof>& a,
                                  const EvaluationPoint<double>& at) const {
    const double w = at.speed;
    const double g_up = gravity * cos(lean);
    const double g_aside = gravity * sin(lean);
    const double a_x =
        a[0] - 2.0 * w * v[1] - w * w * q[0] - at.acceleration * q[1] + g_aside * cos(at.angle);
    const double a_y =
        a[1] + 2.0 * w * v[0] - w * w * q[1] + at.acceleration * q[0] - g_aside * sin(at.angle);
    const double a_z = (v[0] * v[0] + q[0] * a[0] - v[1] * v[1] - q[1] * a[1]) / radius;
    const double slope_x = q[0] / radius;
    const double slope_y = -q[1] / radius;
    return {{"normal_force", "N",
             mass * (a_z + g_up - slope_x * a_x - slope_y * a_y) /
                 std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)}};
  }
  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>& v,
                                    const std::array<double, kDof>& a,
                                    const EvaluationPoint<double>& at) const {
    return {{"contact", "N", reactions(q, v, a, at).front().value, "the ball lifts off the saddle"},
            {"rim", "m", rim - std::hypot(q[0], q[1]), "the ball leaves the saddle"}};
  }

  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>& at) const {
    constexpr double kPi = 3.14159265358979324;
    const double ball = 0.1 * rim;
    const double foot = -1.2 * rim;
    const double c = std::cos(at.angle);
    const double s = std::sin(at.angle);
    const auto above = [&](double x, double y, double height) -> SketchPoint {
      const double z = 0.5 * (x * x - y * y) / radius;
      return {c * x - s * y, s * x + c * y, z + height};
    };
    Sketch sketch;
    sketch.size = 2.4 * rim;
    sketch.height = 2.4 * rim;
    sketch.centre.z = -0.3 * rim;
    sketch.spatial = true;
    for (int ring = 1; ring <= 3; ++ring) {
      Sketch::Line line{{}, SketchRole::kBody};
      for (int i = 0; i <= 48; ++i) {
        const double angle = i * kPi / 24.0;
        const double r = ring * rim / 3.0;
        line.points.push_back(above(r * std::cos(angle), r * std::sin(angle), 0.0));
      }
      sketch.lines.push_back(line);
    }
    for (int spoke = 0; spoke < 8; ++spoke) {
      const double angle = spoke * kPi / 8.0;
      Sketch::Line line{{}, SketchRole::kBody};
      for (int i = -12; i <= 12; ++i) {
        const double r = i * rim / 12.0;
        line.points.push_back(above(r * std::cos(angle), r * std::sin(angle), 0.0));
      }
      sketch.lines.push_back(line);
    }
    sketch.rods = {{{0.0, 0.0, foot}, {0.0, 0.0, 0.0}, 0.04 * rim, SketchRole::kBody}};
    sketch.boxes = {
        {{0.0, 0.0, foot}, {0.8 * rim, 0.8 * rim, 0.1 * rim}, 0.0, SketchRole::kSupport}};
    sketch.balls = {{above(q[0], q[1], ball), ball, SketchRole::kMass}};
    sketch.tracer = sketch.balls.front().at;
    sketch.has_tracer = true;
    return sketch;
  }
};

}  // namespace saddle_trap
