// The least-squares problems of a fit as Ceres sees them.
#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

#include "estimation/shooting.h"
#include "estimation/unknowns.h"

namespace whirl_twin {

// The equations of motion along measured runs: what their accelerations differ by from the model's,
// without stepping anything. Rough, for noise counts twice when it is differentiated, but without
// false minima: where a fit begins.

class EquationError {
 public:
  /// Of the training runs in which every coordinate is measured: by quadratics through the rows
  /// within some hundredths of a second. Study and maker outlive it.
  EquationError(const FitStudy& study, const CandidateMaker& maker);

  bool empty() const { return points_.empty(); }
  Eigen::Index size() const;
  /// Measured less predicted accelerations [size()], in parts of what is usual of each coordinate.
  Eigen::VectorXd residuals(const Candidate& candidate) const;

 private:
  /// Of each channel and input as its column has it: value, first and second derivative.
  struct Point {
    std::size_t run;
    double time;
    Eigen::MatrixX3d measured;
    Eigen::VectorXd inputs;
  };

  const FitStudy& study_;
  const CandidateMaker& maker_;
  std::vector<Point> points_;
  Eigen::VectorXd usual_;  // accelerations
};

/// Beyond `huber` a residual counts linearly: as the square of what this makes of it, which changes
/// with it by `slope`. (Ceres's own losses are of whole blocks, here windows.)
void makeRobust(double huber, Eigen::VectorXd& residuals, Eigen::VectorXd& slope);

/// A window. Blocks: the unknowns, where there are any, and its start, where that is found.
class WindowCost final : public ceres::CostFunction {
 public:
  WindowCost(const Shooting& shooting, const Window& window, const Eigen::VectorXd& given_start,
             bool unknowns);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  const Shooting& shooting_;
  Window window_;
  Eigen::VectorXd given_start_;
  bool unknowns_;
};

/// The equation errors of the training runs. Block: the unknowns.
class EquationCost final : public ceres::CostFunction {
 public:
  EquationCost(const EquationError& equations, const CandidateMaker& maker);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  const EquationError& equations_;
  const CandidateMaker& maker_;
};

}  // namespace whirl_twin
