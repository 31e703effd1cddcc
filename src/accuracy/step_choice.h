// Step selection for `integrator: auto`: the cheapest method and number of substeps that satisfy a
// system's `tolerance` over its `horizon`.
//
// A short calibration, from the scene's start over the horizon or as much of it as the budget
// allows, measures the error of each step setting against a reference (error_bound.h); a linear
// system is tried with the exact step only, where it has one. Then the running error estimate is
// evaluated along the drive's profile, and the substeps are increased where it requires that. The
// budget counts evaluations, not time: the choice for a scene is deterministic.
#pragma once

#include <string>
#include <vector>

#include "accuracy/error_bound.h"
#include "scene/scene.h"

namespace whirl_twin {

struct StepChoice {
  std::string integrator;
  int substeps = 1;
  ErrorBound promise;
  bool raised = false;  ///< for the motion after the horizon, which needs shorter steps
  std::string reason = "";
};

/// Evaluations of accelerations that a scene's calibrations may take.
inline constexpr double kCalibrationBudget = 1.0e8;

/// For a scene of one system.
StepChoice chooseStep(const Scene& one, double budget = kCalibrationBudget);
/// What can be promised of the method and substeps that it names; no reason.
StepChoice judgeStep(const Scene& one, double budget = kCalibrationBudget);

/// One for each system with `auto`; for the others an empty one, or their error bound if
/// judge_named is set. Takes some hundredths of a second for most scenes, about a second where
/// forces are expensive.
std::vector<StepChoice> chooseSteps(const Scene& scene, bool judge_named = false);

/// The scene with the choices: their `chosen_integrator`, `substeps` and `choice_reason`.
Scene withSteps(const Scene& scene, const std::vector<StepChoice>& choices);
Scene withStepsChosen(const Scene& scene);

}  // namespace whirl_twin
