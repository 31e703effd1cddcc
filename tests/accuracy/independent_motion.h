// Reference motion of a system by a method that the twin does not have: Gragg's modified midpoint
// rule, extrapolated in the square of its step to order 16 (Hairer, Norsett & Wanner, Solving
// Ordinary Differential Equations I, 2nd ed. 1993, II.9), with adaptive steps, on the accelerations
// of the model's Dynamics: it shares none of the twin's steppers, drives' phasors or tables. For
// tests of the twin's error bounds.
#pragma once

#include <cstdint>

#include "accuracy/trajectory.h"
#include "accuracy/trajectory_error.h"

namespace whirl_twin {

struct IndependentMotion {
  Trajectory trajectory;  ///< coordinates and rates; fewer samples where the evaluations ran out
  /// From the same with errors a hundred times as large: bounds its own, rounding that the motion
  /// magnifies included.
  ErrorCurve own;
};

/// Of a scene of one system without inputs, `samples` of them an interval [ns] apart, with so many
/// evaluations of the accelerations at most for each of two runs.
IndependentMotion independentMotion(const Scene& one, std::int64_t interval, std::size_t samples,
                                    double evaluations);

}  // namespace whirl_twin
