// Fits the unknowns of a study by multiple shooting (Bock 1983), with the starts of the windows
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

/// A run and its prediction.
struct FittedRun {
  std::vector<MeasuredChannel> channels;  ///< with the fitted offsets and scales
  Eigen::MatrixXd states;   ///< predicted coordinates and rates [2n x rows]; NaN where it stops
  std::vector<double> rms;  ///< of each channel [its unit], over all windows
  /// Lag-one autocorrelation of the residuals of each channel: 0 for white ones.
  std::vector<double> persistence;
  /// The sensor numbers fitted for this run only, with their values.
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

/// Called as (done, of) after each stage and each run.
using FitProgress = std::function<void(int done, int of)>;

/// In unidentifiable directions the unknowns keep their start values. Throws InputError for start
/// values that are invalid for the model, and RunFailure if the motion from them stops within a
/// training run.
ShootingFit fitByShooting(const FitStudy& study, const FitProgress& progress);

}  // namespace whirl_twin
