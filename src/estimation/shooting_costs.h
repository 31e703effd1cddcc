// Cost functions of a fit for Ceres.
#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

#include "estimation/shooting.h"
#include "estimation/unknowns.h"

namespace whirl_twin {

// Equation error: the difference of the accelerations along measured runs from the model's, without
// integration. It amplifies noise by the differentiation, but has no false minima: it gives the
// start of a fit.

class EquationError {
 public:
  /// From the training runs in which every coordinate is measured, by quadratics through the rows
  /// within some hundredths of a second. Study and maker must outlive it.
  EquationError(const FitStudy& study, const CandidateMaker& maker);

  bool empty() const { return points_.empty(); }
  Eigen::Index size() const;
  /// Measured less predicted accelerations [size()], relative to the usual one of each coordinate.
  Eigen::VectorXd residuals(const Candidate& candidate) const;

 private:
  /// Of each channel and input, in the unit of its column: value, first and second derivative.
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

/// Huber loss by residual: replaces each residual beyond `huber` by one whose square grows
/// linearly; slope: derivative of the new residual by the old one. (Ceres's own loss functions act
/// on whole blocks, here windows.)
void makeRobust(double huber, Eigen::VectorXd& residuals, Eigen::VectorXd& slope);

/// Cost of a window. Blocks: the unknowns, if any, and its start, if estimated.
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

/// Equation errors of the training runs. Block: the unknowns.
class EquationCost final : public ceres::CostFunction {
 public:
  EquationCost(const EquationError& equations, const CandidateMaker& maker);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  const EquationError& equations_;
  const CandidateMaker& maker_;
};

}  // namespace whirl_twin
