// What `integrator: auto` stands for: the cheapest method and number of substeps that keep a
// system's `tolerance` over its `horizon`.
//
// A short calibration, from the scene's start over the horizon or as much of it as the budget
// allows, finds the error of each way to step against a reference (promise.h); a linear system is
// tried with the exact step only, where it has one. Then the running estimate is followed through
// the drive's profile, and the substeps are raised where it says so. It counts evaluations and
// never looks at a clock: the same scene gets the same choice on any day.
#pragma once

#include <string>
#include <vector>

#include "accuracy/promise.h"
#include "scene/scene.h"

namespace whirl_twin {

struct StepChoice {
  std::string integrator;
  int substeps = 1;
  Promise promise;
  bool raised = false;  ///< for the motion after the horizon, which needs shorter steps
  std::string reason = "";
};

/// Evaluations of accelerations that a scene's calibrations may take.
inline constexpr double kCalibrationBudget = 1.0e8;

/// For a scene of one system.
StepChoice chooseStep(const Scene& one, double budget = kCalibrationBudget);
/// What can be promised of the method and substeps that it names; no reason.
StepChoice judgeStep(const Scene& one, double budget = kCalibrationBudget);

/// For each system that says `auto`; for others an empty one, or their promise if that is asked
/// for. Takes some hundredths of a second for most scenes, a second or so where forces are dear.
std::vector<StepChoice> chooseSteps(const Scene& scene, bool judge_named = false);

/// The scene with the choices: their `chosen_integrator`, `substeps` and `choice_reason`.
Scene withSteps(const Scene& scene, const std::vector<StepChoice>& choices);
Scene withStepsChosen(const Scene& scene);

}  // namespace whirl_twin
