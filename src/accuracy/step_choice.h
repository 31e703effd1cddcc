// What `integrator: auto` stands for: the cheapest method and number of substeps that keep a
// system's `tolerance` over its `horizon`.
//
// A linear system takes the exact step where it has one, in a run-up in as many parts as a
// tolerance below 1e-7 asks for. For any other a short calibration, from the scene's start over the
// horizon or as much of it as the budget allows, finds the error of each method against a far finer
// run; then the running estimate is followed through the drive's profile, and the substeps are
// raised where it says so. It counts evaluations and never looks at a clock: the same scene gets
// the same choice on any day.
#pragma once

#include <string>

#include "scene/scene.h"

namespace whirl_twin {

struct StepChoice {
  std::string integrator;
  int substeps = 1;
  double error = 0.0;  ///< [-], expected of the positions over the horizon; 0: no truncation error
  double until = 0.0;  ///< [s], how long the tolerance is kept: the horizon, if it can be
  double calibrated = 0.0;  ///< [s], how much of that was looked at; the rest is extrapolated
  bool raised = false;      ///< for the motion after the horizon, which needs shorter steps
  std::string reason = "";
};

/// Evaluations of accelerations that a scene's calibrations may take.
inline constexpr double kCalibrationBudget = 1.0e6;

/// For a scene of one system.
StepChoice chooseStep(const Scene& one, double budget = kCalibrationBudget);

/// The scene with the choice for every `auto`: its `chosen_integrator`, `substeps` and
/// `choice_reason`. Takes a tenth of a second at most for
/// most scenes, a second where forces are dear.
Scene withStepsChosen(const Scene& scene);

}  // namespace whirl_twin
