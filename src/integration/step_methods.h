// The methods a system can be stepped with, by what is known of them before a run.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

struct StepMethod {
  std::string name;  ///< as in scene files
  int order;         ///< of the global error in the step; 0: no truncation error
  bool implicit;
  bool symplectic;  ///< bounded energy error over any time without damping
  bool a_stable;    ///< no limit to the step of a system that is itself stable
  /// Forces that depend on the rates enter at rates that were predicted or are not yet known:
  /// gyroscopic and rotating-damping terms can then make the motion grow.
  bool predicts_rates;
  /// Evaluations of the accelerations in a step; of an implicit method, that of its usual number of
  /// iterations.
  double evaluations;
};

/// All of them, from the lowest order to the exact step.
const std::vector<StepMethod>& stepMethods();

/// Throws std::invalid_argument for an unknown name.
const StepMethod& stepMethod(const std::string& name);

}  // namespace whirl_twin
