// Runs one point of a study: the scene with the point's numbers, simulated, analysed, measured.
#pragma once

#include <yaml-cpp/yaml.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/study.h"

namespace whirl_twin {

/// What became of a point.
struct Outcome {
  std::vector<double> measures;  ///< in the study's order; empty where it failed
  std::string failure;           ///< why it failed; "": it did not
};

/// The evaluation was ended from outside.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// How `integrator: auto` steps the systems of a study: found out once, of the scene as it is, so
/// that it is the same for every point on every machine.
struct StepsChosen {
  struct Choice {
    std::string integrator;
    int substeps = 1;
  };
  std::vector<Choice> choices;  ///< of each system; "": as it says itself
};

/// Takes up to a second. Nothing is looked for in a study that runs nothing.
StepsChosen chooseSteps(const Study& study);

/// Of one thread.
class PointEvaluator {
 public:
  /// Both outlive it, and so does `stop`, which ends an evaluation.
  PointEvaluator(const Study& study, const StepsChosen& steps, const std::atomic<bool>& stop);

  /// With the values of Study::vary. Whatever is wrong with a point is its failure and no
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
  YAML::Node tree_;  // this thread's own: yaml-cpp's are shared as they are copied
};

}  // namespace whirl_twin
