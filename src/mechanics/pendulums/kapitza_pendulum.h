// Kapitza's pendulum: a pendulum whose pivot is shaken up and down, y = a cos(Omega t). If that is
// fast enough, the upright position is stable (A. Stephenson 1908; P. L. Kapitza, Zh. Eksp. Teor.
// Fiz. 21, 1951).
//
//   T = m (l^2 theta'^2 + 2 l y' theta' sin(theta) + y'^2) / 2
//   V = m g (l (1 - cos theta) + y),   D = c theta'^2 / 2
//
// theta is measured from hanging. The mean motion is that of the potential
//   V_mean = m g l (1 - cos theta) + m a^2 Omega^2 sin^2(theta) / 4,
// for a << l and Omega >> sqrt(g/l): upright is stable from a^2 Omega^2 = 2 g l on. Equilibria are
// sought in the mean motion; stability is evaluated for the motion itself (analysis/floquet.h).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct KapitzaPendulum {
  static constexpr const char* kName = "kapitza_pendulum";
  static constexpr const char* kSummary = "pendulum on a vertically vibrating pivot";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta", "rad", "from hanging, the bob to the right"}}};

  double mass = 0.0;       ///< [kg], of the bob
  double length = 0.0;     ///< [m], pivot to bob
  double damping = 0.0;    ///< [N m s/rad]
  double amplitude = 0.0;  ///< [m], a
  double frequency = 0.0;  ///< [rad/s], Omega
  double gravity = 0.0;    ///< [m/s^2], of the scene
  double mean_rate = 0.0;  ///< [m/s], a Omega of the mean motion; 0 in the motion itself

  static constexpr std::array<Parameter<KapitzaPendulum>, 5> parameters() {
    return {{{"mass", "kg", Range::kPositive, &KapitzaPendulum::mass, "of the bob"},
             {"length", "m", Range::kPositive, &KapitzaPendulum::length, "pivot to bob"},
             {"damping", "N m s/rad", Range::kNotNegative, &KapitzaPendulum::damping,
              "viscous, at the pivot", 0.0},
             {"amplitude", "m", Range::kNotNegative, &KapitzaPendulum::amplitude,
              "of the pivot's motion, up and down"},
             {"frequency", "rad/s", Range::kNotNegative, &KapitzaPendulum::frequency,
              "of that motion"}}};
  }

  KapitzaPendulum atMeanLoad() const {
    KapitzaPendulum mean = *this;
    mean.amplitude = 0.0;
    mean.mean_rate = amplitude * frequency;
    return mean;
  }
  std::vector<double> loadFrequencies() const {
    return amplitude == 0.0 || frequency == 0.0 ? std::vector<double>()
                                                : std::vector<double>{frequency};
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {1.0}, "at the pivot, on the pendulum"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 1>& q, const std::array<S, 1>& v,
                              const EvaluationPoint<S>& at) const {
    const S lift = (-amplitude * frequency) * sin(frequency * at.time);
    return (0.5 * mass) * ((length * length) * (v[0] * v[0]) +
                           (2.0 * length) * (sin(q[0]) * (lift * v[0])) + lift * lift);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 1>& q, const EvaluationPoint<S>& at) const {
    const S across = sin(q[0]);
    return (mass * gravity) * (length * (1.0 - cos(q[0])) + amplitude * cos(frequency * at.time)) +
           (0.25 * mass * mean_rate * mean_rate) * (across * across);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 1>&, const std::array<S, 1>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 1> force(const std::array<S, 1>&, const std::array<S, 1>&,
                                           const EvaluationPoint<S>&) const {
    return {};
  }

  /// The arrow shows the pivot's motion as a part of its amplitude.
  Sketch sketch(const std::array<double, 1>& q, const EvaluationPoint<double>& at) const {
    const double l = length;
    const double shake = std::cos(frequency * at.time);
    const SketchPoint pivot{0.0, 0.0, amplitude * shake};
    const SketchPoint bob = hangingPoint(pivot, l, q[0]);
    Sketch s;
    s.size = 2.6 * l;
    s.boxes = {
        {{0.0, 0.07 * l, pivot.z}, {0.26 * l, 0.06 * l, 0.16 * l}, 0.0, SketchRole::kSupport}};
    s.rods = {{pivot, bob, 0.025 * l, SketchRole::kBody},
              {{0.0, 0.1 * l, pivot.z}, {0.0, -0.05 * l, pivot.z}, 0.04 * l, SketchRole::kSupport}};
    s.balls = {{bob, 0.1 * l, SketchRole::kMass}};
    s.arrows = {
        {{0.3 * l, 0.07 * l, 0.0}, {0.3 * l, 0.07 * l, amplitude == 0.0 ? 0.0 : 0.3 * l * shake}}};
    s.tracer = bob;
    s.has_tracer = true;
    return s;
  }
};

}  // namespace whirl_twin
