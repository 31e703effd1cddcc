// The equations of motion along measured runs: what their accelerations differ by from the model's,
// without stepping anything. Rough, for noise counts twice when it is differentiated, but without
// false minima: where a fit begins.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimation/unknowns.h"

namespace whirl_twin {

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

}  // namespace whirl_twin
