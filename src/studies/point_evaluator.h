// Evaluates a point of a study: the scene with its numbers, simulated, analysed, measured.
#pragma once

#include <yaml-cpp/yaml.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/study.h"

namespace whirl_twin {

/// Result of a point.
struct Outcome {
  std::vector<double> measures;  ///< in the study's order; empty if it failed
  std::string failure;           ///< reason; "": it did not fail
};

/// The evaluation was interrupted from outside.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Methods selected by `integrator: auto` for the systems of a study: selected once, for the
/// nominal scene, so that they are the same for every point on every machine.
struct StepsChosen {
  struct Choice {
    std::string integrator;
    int substeps = 1;
  };
  std::vector<Choice> choices;  ///< of each system; "": its own setting
};

/// Takes up to a second. Selects nothing for a study without runs.
StepsChosen chooseSteps(const Study& study);

/// For one thread.
class PointEvaluator {
 public:
  /// Study and steps must outlive it, and so must `stop`, which interrupts an evaluation.
  PointEvaluator(const Study& study, const StepsChosen& steps, const std::atomic<bool>& stop);

  /// At the values of Study::vary. Errors of a point are reported as its failure, not as an
  /// exception. Throws Interrupted.
  Outcome at(const std::vector<double>& values);

  /// The scene with these numbers. Throws SceneError.
  Scene sceneAt(const std::vector<double>& values);

 private:
  void simulate(const Scene& scene, std::vector<std::vector<double>>& leaves);
  std::vector<double> measured(const std::vector<double>& values);

  const Study& study_;
  const StepsChosen& steps_;
  const std::atomic<bool>& stop_;
  YAML::Node tree_;  // a separate copy per thread: yaml-cpp nodes share memory
};

}  // namespace whirl_twin
