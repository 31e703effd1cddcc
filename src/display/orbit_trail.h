// The orbit of the disc centre over the last turns of the shaft, kept with as few points as a
// smooth line needs although it is fed every step.
//
// A point is kept when the shaft or the whirl has advanced far enough since the last one. Between
// points further apart than the eye forgives (a fast rotor makes a large angle a step) the line is
// the cubic Hermite polynomial through positions and velocities, error about advance^4 / 384 of the
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

  /// @param turns [-], turns of the shaft the trail reaches back, > 0
  explicit OrbitTrail(double turns);

  /// Takes the next state. A step back in time, a state that is not finite and a gap too wide to
  /// draw a line across start the trail anew.
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
