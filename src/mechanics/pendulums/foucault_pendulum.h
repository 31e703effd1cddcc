// Foucault's pendulum: a spherical pendulum in a frame that rotates together with the Earth, or on
// a turntable.
//
//   T = m |r' + W x r|^2 / 2,   V = -m g r_z,   D = c |n'|^2 / 2
//   r = l n,   n = (x, y, -l) / sqrt(x^2 + y^2 + l^2)      x to the east, y to the north, z up
//   W = w (0, cos f, sin f)                               f: latitude, w: rate of rotation
//
// x and y are where the thread meets the horizontal plane l below its pivot. Small swings keep
// their plane in inertial space, so that relative to the ground it rotates at -w sin f: clockwise
// in the north. g is that of the plumb line at the pivot.
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

struct FoucaultPendulum {
  static constexpr const char* kName = "foucault_pendulum";
  static constexpr const char* kSummary =
      "pendulum that may swing in any plane, on the rotating Earth";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m", "east: projection of the thread on a floor one length below the pivot (l tan)"},
       {"y", "m", "north, likewise"}}};

  double mass = 0.0;           ///< [kg], of the bob
  double length = 0.0;         ///< [m], pivot to bob
  double damping = 0.0;        ///< [N m s/rad]
  double latitude = 0.0;       ///< [rad]; pi/2 at the pole, and on a turning table
  double rotation_rate = 0.0;  ///< [rad/s], of the Earth or the table
  double gravity = 0.0;        ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<FoucaultPendulum>, 5> parameters() {
    return {{{"mass", "kg", Range::kPositive, &FoucaultPendulum::mass, "of the bob"},
             {"length", "m", Range::kPositive, &FoucaultPendulum::length, "pivot to bob"},
             {"damping", "N m s/rad", Range::kNotNegative, &FoucaultPendulum::damping,
              "viscous, at the pivot", 0.0},
             {"latitude", "rad", Range::kAny, &FoucaultPendulum::latitude,
              "latitude, north positive; pi/2 on a turntable"},
             {"rotation_rate", "rad/s", Range::kAny, &FoucaultPendulum::rotation_rate,
              "of the Earth, or of the table", 7.292115e-5}}};
  }

  double naturalLength() const { return length; }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>&) const {
    const double level = rotation_rate * std::cos(latitude);
    const double upright = rotation_rate * std::sin(latitude);
    const S reach = reachOf(q);
    const S nx = q[0] / reach, ny = q[1] / reach, nz = -length / reach;
    const S outwards = (q[0] * v[0] + q[1] * v[1]) / (reach * reach);
    const S east = (v[0] / reach - nx * outwards) + level * nz - upright * ny;
    const S north = (v[1] / reach - ny * outwards) + upright * nx;
    const S up = -(nz * outwards) - level * nx;
    return (0.5 * mass * length * length) * (east * east + north * north + up * up);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return (mass * gravity * length) * (1.0 - length / reachOf(q));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>&) const {
    const S square = q[0] * q[0] + q[1] * q[1] + length * length;
    const S across = q[0] * v[1] - q[1] * v[0];
    return (0.5 * damping) * (((length * length) * (v[0] * v[0] + v[1] * v[1]) + across * across) /
                              (square * square));
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>&) const {
    return {};
  }

  /// On the ground with a compass: the line points to the north.
  Sketch sketch(const std::array<double, kDof>& q, const EvaluationPoint<double>&) const {
    const double l = length;
    const double floor = -1.12 * l;
    const double part = l / reachOf(q);
    const SketchPoint bob{part * q[0], part * q[1], -part * l};
    Sketch s;
    s.size = 1.6 * l;
    s.height = 1.5 * l;
    s.centre.z = -0.52 * l;
    s.spatial = true;
    s.discs = {
        {{0.0, 0.0, floor}, {0.0, 0.0, 1.0}, 0.6 * l, 0.03 * l, 0.5 * M_PI, SketchRole::kSupport}};
    s.rods = {{{}, bob, 0.008 * l, SketchRole::kBody},
              {{0.0, 0.0, 0.08 * l}, {}, 0.03 * l, SketchRole::kSupport}};
    s.balls = {{bob, 0.06 * l, SketchRole::kMass}};
    s.lines = {
        {{{0.0, 0.0, floor + 0.02 * l}, {0.0, 0.55 * l, floor + 0.02 * l}}, SketchRole::kMark}};
    s.tracer = bob;
    s.has_tracer = true;
    return s;
  }

 private:
  /// [m], from the pivot to where the thread points to.
  template <class S>
  WHIRL_TWIN_INLINE S reachOf(const std::array<S, kDof>& q) const {
    return sqrt(q[0] * q[0] + q[1] * q[1] + length * length);
  }
};

}  // namespace whirl_twin
