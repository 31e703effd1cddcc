// What a candidate predicts over a stretch of a measured run, from a start of its own.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "estimation/unknowns.h"

namespace whirl_twin {

/// Rows of a run that are predicted in one go.
struct Window {
  std::size_t run = 0;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The windows of a run: as many of `length` [s] as it has, each from the row at which the one
/// before ends; what is left over belongs to the last one, or is one of its own where it is longer
/// than half of that. A row that a gap leaves alone belongs to the window before it.
std::vector<Window> windowsOf(const FitStudy& study, std::size_t run, double length);

/// Steps the candidate through the window's rows with the system's own method and the scene's step,
/// from `start`, its coordinates and rates [2n], at the first row, under the run's inputs. Between
/// steps states are cubic (Hermite). Column k of the result: coordinates and rates at row k [2n x
/// count]. False, and the result is not of use, if it stops on the way.
bool predict(const FitStudy& study, const BuiltScene& scene, const Candidate& candidate,
             const Window& window, const Eigen::VectorXd& start, Eigen::MatrixXd& states);

/// Measured less predicted, in deviations: channel after channel, row by row [channels * count].
Eigen::VectorXd residuals(const FitStudy& study, const Candidate& candidate, const Window& window,
                          const Eigen::MatrixXd& states);
std::size_t residualCount(const FitStudy& study, const Window& window);

/// Coordinates and rates [2n] at the first row as measured: by a quadratic through the rows about
/// it, those of the window only. What is not measured is as the scene starts.
Eigen::VectorXd measuredStart(const FitStudy& study, const Candidate& candidate,
                              const Window& window);

}  // namespace whirl_twin
