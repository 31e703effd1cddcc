// The least-squares problems of a fit as Ceres sees them.
#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>

#include "estimation/equation_error.h"
#include "estimation/shooting.h"

namespace whirl_twin {

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
