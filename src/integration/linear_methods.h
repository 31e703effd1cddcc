// What each method makes of a linear system: the matrices of one step (linear_step.h). Prepared
// once; nothing here is for the real-time path.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mechanics/linear_dynamics.h"

namespace whirl_twin {

/// The system in y = (q, v, cos w_1 t, sin w_1 t, cos w_2 t ...), one pair of phasors for every
/// frequency of its forces, 0 among them.
class LinearEquation {
 public:
  explicit LinearEquation(const LinearModel& model);

  Eigen::Index dof() const { return model_.mass.rows(); }
  Eigen::Index size() const { return forcing_.cols() + 2 * dof(); }        ///< of y
  const std::vector<double>& frequencies() const { return frequencies_; }  ///< [rad/s], >= 0
  const LinearModel& model() const { return model_; }
  const Eigen::MatrixXd& forcing() const { return forcing_; }  ///< F with f = F phasors [n x .]

  Eigen::MatrixXd velocity() const;      ///< v = velocity y [n x size]
  Eigen::MatrixXd acceleration() const;  ///< q'' = acceleration y [n x size]
  Eigen::MatrixXd power() const;         ///< S: dh/dt = y^T S y [size x size]
  /// Z with (q + dq y, v + dv y, phasors of `offset` [s] later) = Z y; dq and dv [n x size].
  Eigen::MatrixXd stage(const Eigen::MatrixXd& dq, const Eigen::MatrixXd& dv, double offset) const;

 private:
  const LinearModel& model_;
  std::vector<double> frequencies_;
  Eigen::MatrixXd forcing_;
};

struct LinearStepMap {
  Eigen::MatrixXd increment;  ///< B: (dq, dv) = B y [2 n x size]
  Eigen::MatrixXd work;       ///< W: work = y^T W y [size x size]
};

/// The matrices of a step of h [s]: NaN throughout where the system's own are beyond the range of
/// doubles. Throws std::invalid_argument for an unknown method.
LinearStepMap linearStepMap(const LinearEquation& equation, const std::string& method, double h);

/// The names it knows.
const std::vector<std::string>& linearMethodNames();

}  // namespace whirl_twin
