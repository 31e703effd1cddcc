// Uniform rigid beam on a hinge, with a spring at its middle and a dashpot at its end, under a
// uniform load (lecture notes, "rigid beam"). Finite rotation: spring, dashpot and load stay
// vertical.
//
//   T = M l^2 theta'^2 / 6,   V = k (l sin(theta) / 2)^2 / 2,   D = c (l cos(theta) theta')^2 / 2
//   Q = f(t) l^2 cos(theta) / 2,   f = f0 cos(Omega t) per length
//
// theta is measured from the beam's equilibrium under its weight, in the sense of the load.
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

struct HingedBeam {
  static constexpr const char* kName = "hinged_beam";
  static constexpr const char* kSummary = "rigid beam on a hinge, with spring, dashpot and load";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta", "rad", "from the equilibrium under its weight, in the direction of the load"}}};

  double mass = 0.0;            ///< [kg], of the beam
  double length = 0.0;          ///< [m], of the beam
  double stiffness = 0.0;       ///< [N/m], of the spring at the middle
  double damping = 0.0;         ///< [N s/m], of the dashpot at the end
  double load_amplitude = 0.0;  ///< [N/m], of the load
  double load_frequency = 0.0;  ///< [rad/s], of the load; 0: constant

  static constexpr std::array<Parameter<HingedBeam>, 6> parameters() {
    return {{{"mass", "kg", Range::kPositive, &HingedBeam::mass, "of the beam"},
             {"length", "m", Range::kPositive, &HingedBeam::length, "of the beam"},
             {"stiffness", "N/m", Range::kNotNegative, &HingedBeam::stiffness,
              "of the spring at the middle"},
             {"damping", "N s/m", Range::kNotNegative, &HingedBeam::damping,
              "of the dashpot at the end", 0.0},
             {"load_amplitude", "N/m", Range::kAny, &HingedBeam::load_amplitude,
              "of the load on the beam", 0.0},
             {"load_frequency", "rad/s", Range::kNotNegative, &HingedBeam::load_frequency,
              "of the load; 0: constant", 0.0}}};
  }

  bool loadAlternates() const { return load_amplitude != 0.0 && load_frequency != 0.0; }
  HingedBeam atMeanLoad() const {
    HingedBeam mean = *this;
    mean.load_amplitude = loadAlternates() ? 0.0 : load_amplitude;
    return mean;
  }
  std::vector<double> loadFrequencies() const {
    return loadAlternates() ? std::vector<double>{load_frequency} : std::vector<double>();
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {1.0}, "at the hinge, on the beam"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    return (mass * length * length / 6.0) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    const S stretch = (0.5 * length) * sin(q[0]);
    return (0.5 * stiffness) * (stretch * stretch);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    const S end = length * (cos(q[0]) * v[0]);
    return (0.5 * damping) * (end * end);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>& at) const {
    return {(0.5 * length * length) * (load(at) * cos(q[0]))};
  }

  /// The load points down; so does a positive theta.
  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>& at) const {
    const auto along = [&](double part) {
      return SketchPoint{part * length * std::cos(q[0]), 0.0, -part * length * std::sin(q[0])};
    };
    const double ground = -1.1 * length;
    const auto below = [&](const SketchPoint& p) { return SketchPoint{p.x, p.y, ground}; };
    const SketchPoint middle = along(0.5);
    const SketchPoint end = along(1.0);
    Sketch s;
    s.size = 1.6 * length;
    s.height = 2.6 * length;
    s.centre.x = 0.5 * length;
    s.rods.push_back({along(0.0), end, 0.02 * length, SketchRole::kBody});
    addPin(s, {});
    if (stiffness > 0.0) {
      s.springs.push_back({below(middle), middle, 0.04 * length});
    }
    if (damping != 0.0) {
      s.dampers.push_back({below(end), end, 0.04 * length});
    }
    s.lines.push_back(
        {{{-0.1 * length, 0.0, ground}, {1.1 * length, 0.0, ground}}, SketchRole::kSupport});
    if (load_amplitude != 0.0) {
      const double arrow = 0.3 * length * load(at) / std::abs(load_amplitude);
      for (const double part : {0.2, 0.4, 0.6, 0.8}) {
        const SketchPoint foot = along(part);
        s.arrows.push_back({{foot.x, foot.y, foot.z + arrow}, foot});
      }
    }
    s.tracer = end;
    s.has_tracer = true;
    return s;
  }

 protected:
  /// [N/m]
  template <class S>
  WHIRL_TWIN_INLINE S load(const EvaluationPoint<S>& at) const {
    return load_amplitude * cos(load_frequency * at.time);
  }
};

// The hinged beam at small angles, as the lecture notes print it: (M/3) theta'' + c theta' +
// (k/4) theta = f(t)/2, times l^2.
//
//   T = M l^2 theta'^2 / 6,   V = k (l theta / 2)^2 / 2,   D = c (l theta')^2 / 2
//   Q = f(t) l^2 / 2

struct SmallHingedBeam : HingedBeam {
  static constexpr bool kLinear = true;

  static constexpr std::array<Parameter<SmallHingedBeam>, 6> parameters() {
    return inherited<SmallHingedBeam>(HingedBeam::parameters());
  }

  SmallHingedBeam atMeanLoad() const {
    SmallHingedBeam mean = *this;
    mean.load_amplitude = loadAlternates() ? 0.0 : load_amplitude;
    return mean;
  }

  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return (0.125 * stiffness * length * length) * (q[0] * q[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    return (0.5 * damping * length * length) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>& at) const {
    return {(0.5 * length * length) * load(at)};
  }
};

}  // namespace whirl_twin
