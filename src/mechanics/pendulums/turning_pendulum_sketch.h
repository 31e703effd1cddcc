// The picture of a pendulum whose plane turns about the vertical through its pivot: on the end of a
// shaft, under a bracket.
#pragma once

#include <cmath>

#include "mechanics/sketch.h"

namespace whirl_twin {

/// @param length pivot to bob [m] @param theta from hanging [rad] @param plane of the plane [rad]
/// @param hub radius of the disc that rotates together with the plane [m]
inline Sketch turningPendulumSketch(double length, double theta, double plane, double hub) {
  const double post = 1.25 * length;  // behind the pendulum, clear of the bob
  const double arm = 0.3 * length;    // above the pivot
  const double foot = -2.0 * length;
  const double out = length * std::sin(theta);
  const SketchPoint pivot;
  const SketchPoint bob{out * std::cos(plane), out * std::sin(plane), -length * std::cos(theta)};
  const SketchPoint pin{-0.1 * length * std::sin(plane), 0.1 * length * std::cos(plane), 0.0};

  Sketch s;
  s.size = 2.5 * length;
  s.height = 0.55 * length - foot;
  s.centre.z = 0.55 * length - 0.5 * s.height;
  s.spatial = true;
  s.boxes = {{{0.0, post, 0.5 * (arm + foot)},
              {0.13 * length, 0.13 * length, arm - foot},
              0.0,
              SketchRole::kSupport},
             {{0.0, 0.5 * post, arm + 0.06 * length},
              {0.12 * length, post + 0.13 * length, 0.12 * length},
              0.0,
              SketchRole::kSupport}};
  // The pin lies across the plane of the swing and, with the hub, shows how the plane has turned.
  s.rods = {{pivot, bob, 0.025 * length, SketchRole::kBody},
            {pivot, {0.0, 0.0, arm}, 0.04 * length, SketchRole::kBody},
            {{-pin.x, -pin.y, 0.0}, pin, 0.035 * length, SketchRole::kBody}};
  s.discs = {
      {{0.0, 0.0, 0.6 * arm}, {0.0, 0.0, 1.0}, hub, 0.06 * length, plane, SketchRole::kBody}};
  s.balls = {{bob, 0.1 * length, SketchRole::kMass}};
  s.lines = {{{{0.0, 0.0, 0.5 * length}, {0.0, 0.0, foot}}, SketchRole::kMark}};
  s.tracer = bob;
  s.has_tracer = true;
  return s;
}

}  // namespace whirl_twin
