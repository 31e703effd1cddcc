// The orbit of the disc centre over the last turns of the shaft, stored with as few points as a
// smooth line needs although it receives every step.
//
// A point is stored when the shaft or the whirl has advanced far enough since the last one. Between
// points too far apart for a polyline (a fast rotor makes a large angle a step) the line is the
// cubic Hermite polynomial through positions and velocities, error about advance^4 / 384 of the
// radius.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <vector>

#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

class OrbitTrail {
 public:
  static constexpr std::size_t kMaxPoints = 600;

  /// @param turns [-], length of the trail in turns of the shaft, > 0
  explicit OrbitTrail(double turns);

  /// Adds the next state. A step back in time, a state that is not finite or a gap too wide to
  /// bridge by a line restarts the trail.
  void add(const WhirlState& state);

  void clear();

  /// Points of the line in rotor axes x, y [m], oldest first; at most kMaxPoints.
  std::vector<Eigen::Vector2d> points() const;

 private:
  struct Sample {
    double time;         // s
    double shaft_angle;  // rad
    Eigen::Vector2d position;
    Eigen::Vector2d velocity;
  };

  double advance(const Sample& from, const Sample& to) const;

  double turns_;
  double extent_ = 0.0;  // [m], largest radius since the trail began
  std::deque<Sample> samples_;
  Sample newest_{};
};

}  // namespace whirl_twin
