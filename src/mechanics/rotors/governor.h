// Centrifugal governor on an engine: the balls rise as the shaft turns faster and close the
// throttle. The classical third-order example of the Routh criterion (lecture notes, "Routh
// criteria"): steady running is stable while c J / (m l^2) > 2 F / w0.
//
//   T = m l^2 theta'^2 / 2 + J phi'^2 / 2,   V = m g l (1 - cos theta),   D = c theta'^2 / 2
//   Q = (m l^2 phi'^2 sin(theta) cos(theta),  kappa cos(theta) - F)
//
// The coupling of the balls into the shaft is neglected: neither their inertia about the vertical
// nor the moment they need to keep up with the shaft loads the engine, whose inertia is far larger.
// So the centrifugal moment on theta is an external force here, and does work.
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

struct Governor {
  static constexpr const char* kName = "governor";
  static constexpr const char* kSummary =
      "centrifugal governor on an engine under load; the moment of its balls on the shaft is "
      "neglected";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta", "rad", "of the arms, from hanging, outwards"},
       {"phi", "rad", "of the shaft, in the direction of the engine"}}};

  double mass = 0.0;     ///< [kg], of both balls together
  double length = 0.0;   ///< [m], of the arms
  double inertia = 0.0;  ///< [kg m^2], of the engine
  double damping = 0.0;  ///< [N m s/rad], viscous, on theta
  double torque = 0.0;   ///< [N m], of the engine with the arms down; it gives this cos(theta)
  double load = 0.0;     ///< [N m], on the engine
  double gravity = 0.0;  ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<Governor>, 6> parameters() {
    return {{{"mass", "kg", Range::kPositive, &Governor::mass, "of both balls together"},
             {"length", "m", Range::kPositive, &Governor::length, "of the arms"},
             {"inertia", "kg m^2", Range::kPositive, &Governor::inertia, "of the engine"},
             {"damping", "N m s/rad", Range::kNotNegative, &Governor::damping, "viscous, on theta",
              0.0},
             {"torque", "N m", Range::kNotNegative, &Governor::torque,
              "of the engine with the arms down; falls with cos(theta)"},
             {"load", "N m", Range::kAny, &Governor::load, "on the engine"}}};
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {0.0, 1.0}, "on the engine's shaft"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    return (0.5 * mass * length * length) * (v[0] * v[0]) + (0.5 * inertia) * (v[1] * v[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return (mass * gravity * length) * (1.0 - cos(q[0]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>& v,
                                              const EvaluationPoint<S>&) const {
    const S down = cos(q[0]);
    return {(mass * length * length) * (v[1] * v[1] * (sin(q[0]) * down)), torque * down - load};
  }

  /// The engine is the disc at the foot of the spindle.
  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    const SketchPoint pivot{};
    const SketchPoint foot{0.0, 0.0, -1.3 * length};
    Sketch s;
    s.size = 2.6 * length;
    s.height = 1.8 * length;
    s.centre.z = -0.5 * length;
    s.spatial = true;
    s.rods.push_back({foot, {0.0, 0.0, 0.1 * length}, 0.03 * length, SketchRole::kBody});
    s.discs.push_back({foot, {0.0, 0.0, 1.0}, 0.6 * length, 0.1 * length, q[1], SketchRole::kBody});
    for (const double side : {1.0, -1.0}) {
      const double out = side * length * std::sin(q[0]);
      const SketchPoint ball{out * std::cos(q[1]), out * std::sin(q[1]), -length * std::cos(q[0])};
      s.rods.push_back({pivot, ball, 0.015 * length, SketchRole::kBody});
      s.balls.push_back({ball, 0.08 * length, SketchRole::kMass});
      s.tracer = ball;
    }
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
