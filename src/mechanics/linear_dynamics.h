// A linear system given by its matrices, of any number of coordinates (lecture notes, influence
// coefficients, semidefinite systems, assumed modes):
//
//   M q'' + (C + G) q' + (K + N) q = sum of F_j cos(w_j t + phase_j)
//
// C, K symmetric (damping, stiffness), G, N skew (gyroscopic, circulatory). With T = q'^T M q' / 2,
// V = q^T K q / 2, D = q'^T C q' / 2 the Jacobi integral is h = T + V, and
//   dh/dt = -q'^T C q' + q'^T (f - N q).
// The matrices are used directly: dual numbers of n coordinates would cost n^4.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "algebra/dense.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// amplitude * cos(frequency * t + phase); constant at frequency 0.
struct HarmonicForce {
  Eigen::VectorXd amplitude;  ///< [N] or [N m], one a coordinate
  double frequency = 0.0;     ///< [rad/s]
  double phase = 0.0;         ///< [rad]
};

/// All matrices are n x n for n coordinates, in their units; M is positive definite.
struct LinearModel {
  std::string model;
  std::vector<CoordinateInfo> coordinates;
  Eigen::MatrixXd mass, damping, gyroscopic, stiffness, circulatory;
  std::vector<HarmonicForce> forces = {};
  std::vector<InputInfo> inputs = {};
  /// Its picture at coordinates q and time [s]; may be empty.
  std::function<Sketch(const Eigen::VectorXd& q, double time)> sketch = {};
};

class LinearDynamics final : public Dynamics {
 public:
  /// Throws InputError for matrices or forces of the wrong size and for a mass matrix
  /// that is not positive definite.
  explicit LinearDynamics(LinearModel model);

  const LinearModel& linearModel() const { return model_; }
  /// The generalized force of the surroundings at a time [s].
  Eigen::VectorXd force(double time) const;

  std::string model() const override { return model_.model; }
  int dof() const override { return static_cast<int>(model_.coordinates.size()); }
  std::vector<CoordinateInfo> coordinates() const override { return model_.coordinates; }
  std::vector<InputInfo> inputs() const override { return model_.inputs; }
  bool linear() const override { return true; }
  bool hasShaft() const override { return false; }
  bool isRotor() const override { return false; }
  bool speedDependent() const override { return false; }
  double phaseMark() const override { return 0.0; }
  /// The largest deflection that a force's amplitude causes when it acts slowly; 1 without forces.
  double naturalLength() const override { return natural_length_; }
  const Dynamics& atMeanLoad() const override { return at_mean_load_ ? *at_mean_load_ : *this; }

  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override;
  Eigen::VectorXd residualForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                const EvaluationPoint<double>& at) const override;
  Eigen::VectorXd appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override;
  Eigen::MatrixXd massMatrix(const Eigen::VectorXd&, const Eigen::VectorXd&,
                             const EvaluationPoint<double>&) const override {
    return model_.mass;
  }
  Eigen::VectorXd momenta(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                          const EvaluationPoint<double>& at) const override;
  Energies energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const EvaluationPoint<double>& at) const override;
  Linearization linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a,
                              const EvaluationPoint<double>& at) const override;
  std::vector<Reaction> reactions(const Eigen::VectorXd&, const Eigen::VectorXd&,
                                  const Eigen::VectorXd&,
                                  const EvaluationPoint<double>&) const override {
    return {};
  }
  std::vector<Condition> conditions(const Eigen::VectorXd&, const Eigen::VectorXd&,
                                    const Eigen::VectorXd&,
                                    const EvaluationPoint<double>&) const override {
    return {};
  }
  std::string singularMass() const override { return ""; }
  Sketch sketch(const Eigen::VectorXd& q, const EvaluationPoint<double>& at) const override {
    return model_.sketch ? model_.sketch(q, at.time) : Sketch{};
  }

 private:
  LinearModel model_;
  Cholesky mass_;
  double natural_length_ = 1.0;
  std::unique_ptr<const LinearDynamics> at_mean_load_;  // none: no force alternates
};

}  // namespace whirl_twin
