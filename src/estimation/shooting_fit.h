// Finds the unknowns of a study by multiple shooting (Bock 1983), the starts of the windows
// eliminated (Schur complement): least squares by Ceres, within bounds.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "estimation/fit_study.h"
#include "estimation/information.h"
#include "estimation/unknowns.h"

namespace whirl_twin {

/// A run beside what is predicted of it.
struct FittedRun {
  std::vector<MeasuredChannel> channels;  ///< with the zeros and scales that were found
  Eigen::MatrixXd states;   ///< predicted coordinates and rates [2n x rows]; NaN where it stops
  std::vector<double> rms;  ///< of each channel [its unit], over all windows
  /// Of each channel, correlation of a residual with the next one: 0 for white ones.
  std::vector<double> persistence;
  /// The numbers of sensors that it has for itself, with their values.
  std::vector<std::pair<Unknown, double>> own;
};

struct ShootingFit {
  std::vector<Unknown> unknowns;
  Eigen::VectorXd theta;  ///< in their order
  Information information;
  std::vector<bool> at_bound;  ///< of each unknown
  std::vector<FittedRun> runs;
  int iterations = 0;
  bool converged = true;
};

/// told(done, of) after each stage and each run.
using FitProgress = std::function<void(int done, int of)>;

/// In directions that the runs do not tell the unknowns stay where they start. Throws Refusal for
/// start values that the model cannot have, and RunFailure where the motion does not get through a
/// training run from them.
ShootingFit fitByShooting(const FitStudy& study, const FitProgress& progress);

}  // namespace whirl_twin
