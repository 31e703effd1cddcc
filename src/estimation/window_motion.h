// Predicted motion of a candidate over a window of a measured run, from the window's own start.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "estimation/unknowns.h"

namespace whirl_twin {

/// Rows of a run that are predicted together.
struct Window {
  std::size_t run = 0;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The windows of a run: as many of `length` [s] as it has, each from the last row of the one
/// before. A remainder longer than half of `length` is a window, a shorter one is part of the last
/// window. A single row separated by a gap belongs to the window before it.
std::vector<Window> windowsOf(const FitStudy& study, std::size_t run, double length);

/// Integrates the candidate through the window's rows with the system's own method and the scene's
/// step, from `start`, its coordinates and rates [2n], at the first row, under the run's inputs.
/// Between steps states are cubic (Hermite). Column k of the result: coordinates and rates at row k
/// [2n x count]. False, with an unusable result, if the motion stops before the end.
bool predict(const FitStudy& study, const BuiltScene& scene, const Candidate& candidate,
             const Window& window, const Eigen::VectorXd& start, Eigen::MatrixXd& states);

/// Measured less predicted, in standard deviations: channel after channel, row by row [channels *
/// count].
Eigen::VectorXd residuals(const FitStudy& study, const Candidate& candidate, const Window& window,
                          const Eigen::MatrixXd& states);
std::size_t residualCount(const FitStudy& study, const Window& window);

/// Coordinates and rates [2n] at the first row as measured: from a quadratic through nearby rows of
/// the window. Those not measured have the scene's start values.
Eigen::VectorXd measuredStart(const FitStudy& study, const Candidate& candidate,
                              const Window& window);

}  // namespace whirl_twin
