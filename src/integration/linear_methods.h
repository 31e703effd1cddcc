// Matrices of one step of each method for a linear system (linear_stepper.h). Prepared once; not
// real-time safe.
//
// The value of an input at the start of a step does the work u . dq with every method; the work of
// its change in the step is computed at the method's nodes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "integration/applied_inputs.h"
#include "mechanics/linear_dynamics.h"

namespace whirl_twin {

/// The system in y = (q, v, cos w_1 t, sin w_1 t, cos w_2 t ..., u_1, u_1' ...): one pair of
/// phasors for every frequency of its forces, 0 among them, then one pair for each input
/// (applied_inputs.h, in units of 1 s).
class LinearEquation {
 public:
  LinearEquation(const LinearModel& model, const AppliedInputs& inputs);

  Eigen::Index dof() const { return model_.mass.rows(); }
  Eigen::Index size() const { return forcing_.cols() + 2 * dof(); }        ///< of y
  const std::vector<double>& frequencies() const { return frequencies_; }  ///< [rad/s], >= 0
  const LinearModel& model() const { return model_; }
  const Eigen::MatrixXd& forcing() const { return forcing_; }  ///< F with f = F pairs [n x .]
  const AppliedInputs& inputs() const { return inputs_; }
  Eigen::Index inputColumn(Eigen::Index k) const;  ///< in y, of the pair of an input
  /// G of a pair of phasors or of an input, y' = G y.
  Eigen::Matrix2d generator(Eigen::Index pair) const;

  Eigen::MatrixXd velocity() const;      ///< v = velocity y [n x size]
  Eigen::MatrixXd acceleration() const;  ///< q'' = acceleration y [n x size]
  Eigen::MatrixXd power() const;         ///< S: dh/dt = y^T S y [size x size]
  /// Z with (q + dq y, v + dv y, phasors of `offset` [s] later) = Z y; dq and dv [n x size].
  Eigen::MatrixXd stage(const Eigen::MatrixXd& dq, const Eigen::MatrixXd& dv, double offset) const;

 private:
  const LinearModel& model_;
  const AppliedInputs& inputs_;
  std::vector<double> frequencies_;
  Eigen::MatrixXd forcing_;
};

struct LinearStepMap {
  Eigen::MatrixXd increment;  ///< B: (dq, dv) = B y [2 n x size]
  Eigen::MatrixXd work;       ///< W: work = y^T W y [size x size]
};

/// The matrices of a step of h [s]: NaN throughout where the system's own are beyond the range of
/// doubles. Throws std::logic_error for an unknown method.
LinearStepMap linearStepMap(const LinearEquation& equation, const std::string& method, double h);

/// Those of exact steps of 1, 2, 4 ... nanoseconds, up to the longest of at most `longest` [ns].
std::vector<LinearStepMap> exactParts(const LinearEquation& equation, std::int64_t longest);

/// The supported names.
const std::vector<std::string>& linearMethodNames();

}  // namespace whirl_twin
