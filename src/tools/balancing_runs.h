// The runs that `twin balance` reads: vibration readings, and the trial masses.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "analysis/balancing.h"

namespace whirl_twin {

struct BalancingRuns {
  std::vector<std::string> probes, planes;  ///< each name once
  Eigen::VectorXcd initial;                 ///< of each probe: amplitude e^(-i lag), any unit
  Eigen::VectorXd weights;                  ///< of each probe, >= 0 and not all 0
  std::vector<TrialRun> trials;             ///< at least one for each plane
  /// Standard deviation of either component of a reading, in its unit; 0: not specified.
  double deviation = 0.0;
  std::string unit;  ///< SI unit of all amplitudes: m, m/s or m/s^2; "": they have none
};

/// Reads them from a YAML file. Throws InputError with all its errors. The limits on the values
/// exclude overflow in the computations that follow.
BalancingRuns readBalancingRuns(const std::string& path);

}  // namespace whirl_twin
