// A linear rotor with nonlinear nodal forces (local_force.h),
//
//   M q'' + (C + G) q' + (K + N) q = f + sum of along_x F_x + along_y F_y.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algebra/dense.h"
#include "mechanics/dynamics.h"
#include "mechanics/local_force.h"

namespace whirl_twin {

class LocallyForcedRotor final : public Dynamics {
 public:
  /// The rotor with what of the forces is linear.
  LocallyForcedRotor(std::shared_ptr<const Dynamics> linear, std::vector<LocalForce> forces);

  std::string model() const override { return linear_->model(); }
  int dof() const override { return linear_->dof(); }
  std::vector<CoordinateInfo> coordinates() const override { return linear_->coordinates(); }
  std::vector<InputInfo> inputs() const override { return linear_->inputs(); }
  bool linear() const override { return false; }
  const std::vector<LocalForce>& forces() const { return forces_; }
  bool hasShaft() const override { return linear_->hasShaft(); }
  bool isRotor() const override { return linear_->isRotor(); }
  bool speedDependent() const override { return linear_->speedDependent(); }
  double phaseMark() const override { return linear_->phaseMark(); }
  double naturalLength() const override { return natural_length_; }
  const Dynamics& atMeanLoad() const override { return balanced_ ? *balanced_ : *this; }
  std::vector<Station> stations() const override { return linear_->stations(); }
  std::vector<Station> casing() const override { return linear_->casing(); }
  /// Without the nonlinear forces.
  LinearRotor linearRotor() const override { return linear_->linearRotor(); }

  // Where a law has no place for the rotor its forces are no numbers.

  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override;
  Eigen::VectorXd residualForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                const EvaluationPoint<double>& at) const override;
  Eigen::VectorXd appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override;
  Eigen::MatrixXd massMatrix(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             const EvaluationPoint<double>& at) const override {
    return linear_->massMatrix(q, v, at);
  }
  Eigen::VectorXd momenta(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                          const EvaluationPoint<double>& at) const override {
    return linear_->momenta(q, v, at);
  }
  Energies energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const EvaluationPoint<double>& at) const override;
  Linearization linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a,
                              const EvaluationPoint<double>& at) const override;
  std::vector<Reaction> reactions(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                  const Eigen::VectorXd& a,
                                  const EvaluationPoint<double>& at) const override {
    return linear_->reactions(q, v, a, at);
  }
  /// The condition of clearance at each force.
  std::vector<Condition> conditions(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                    const Eigen::VectorXd& a,
                                    const EvaluationPoint<double>& at) const override;
  std::string singularMass() const override { return linear_->singularMass(); }
  Sketch sketch(const Eigen::VectorXd& q, const EvaluationPoint<double>& at) const override {
    return linear_->sketch(q, at);
  }

 private:
  Eigen::VectorXd localForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             double speed) const;

  std::shared_ptr<const Dynamics> linear_;
  std::vector<LocalForce> forces_;
  double natural_length_;
  Cholesky mass_;
  std::unique_ptr<const LocallyForcedRotor> balanced_;  // none: no synchronous force
};

}  // namespace whirl_twin
