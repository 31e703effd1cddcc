// A linear rotor, with or without local forces, whose shaft a motor turns (spin_coupling.h): one
// coordinate more, the angle of the shaft.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/local_force.h"
#include "mechanics/spin_coupling.h"

namespace whirl_twin {

class SpinningRotor final : public Dynamics {
 public:
  /// `held`: the rotor as it whirls while its shaft's motion is prescribed, with these local
  /// forces. Throws InputError for unbalances that the polar inertia cannot carry, std::logic_error
  /// for forces on the shaft that have no mass.
  SpinningRotor(std::shared_ptr<const Dynamics> held, std::vector<LocalForce> forces,
                SpinCoupling coupling);

  const Dynamics& held() const { return *held_; }
  const SpinCoupling& coupling() const { return coupling_; }
  /// Those of the held rotor.
  const std::vector<LocalForce>& forces() const { return forces_; }

  std::string model() const override { return held_->model(); }
  int dof() const override { return held_->dof() + 1; }
  std::vector<CoordinateInfo> coordinates() const override;
  /// Those of the rotor, and a torque on its shaft.
  std::vector<InputInfo> inputs() const override;
  bool linear() const override { return false; }
  bool hasShaft() const override { return false; }
  bool isRotor() const override { return true; }
  bool speedDependent() const override { return false; }
  double phaseMark() const override { return held_->phaseMark(); }
  double naturalLength() const override { return held_->naturalLength(); }
  const Dynamics& atMeanLoad() const override { return balanced_ ? *balanced_ : *this; }
  std::vector<Station> stations() const override { return turned(held_->stations()); }
  std::vector<Station> casing() const override { return turned(held_->casing()); }

  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override;
  Eigen::VectorXd residualForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                const EvaluationPoint<double>& at) const override;
  Eigen::VectorXd appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override;
  Eigen::MatrixXd massMatrix(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             const EvaluationPoint<double>& at) const override;
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
  std::vector<Condition> conditions(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                    const Eigen::VectorXd& a,
                                    const EvaluationPoint<double>& at) const override;
  std::string singularMass() const override { return held_->singularMass(); }
  Sketch sketch(const Eigen::VectorXd& q, const EvaluationPoint<double>& at) const override;

 private:
  /// Places of the held rotor, in its coordinates and the angle of its shaft.
  static std::vector<Station> turned(std::vector<Station> places);
  Eigen::VectorXd lever(double angle) const;      ///< s
  Eigen::VectorXd leverTurn(double angle) const;  ///< ds / d theta
  double localMoment(const Eigen::VectorXd& x, const Eigen::VectorXd& r, double speed) const;
  double torque(const Eigen::VectorXd& x, const Eigen::VectorXd& r, double speed) const;

  std::shared_ptr<const Dynamics> held_;
  std::vector<LocalForce> forces_;
  SpinCoupling coupling_;
  Eigen::VectorXcd unbalance_;  ///< F
  Eigen::MatrixXd mass_;
  std::unique_ptr<const SpinningRotor> balanced_;  // none: no synchronous force
};

/// F of a rotor: the sum of its forces of harmonic 1. Throws std::logic_error for any other.
Eigen::VectorXcd unbalanceOf(const LinearRotor& rotor);

}  // namespace whirl_twin
