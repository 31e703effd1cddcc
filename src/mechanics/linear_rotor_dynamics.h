// A linear rotor of any number of coordinates behind the interface of all models.
//
// T = q'^T M q' / 2, V = q^T K(w) q / 2 - f_0 . q; h = T + V. Gyroscopic forces do no work;
//   dh/dt = -q'^T C q' - q'^T N q + q' . f + a q^T (dK/dw) q / 2,
// the last term where a bearing's stiffness follows the speed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algebra/dense.h"
#include "mechanics/dynamics.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

/// Properties of a linear rotor besides its matrices.
struct RotorDescription {
  std::string model;
  std::vector<CoordinateInfo> coordinates;
  std::vector<Station> stations;     ///< the published one first
  std::vector<Station> casing = {};  ///< what moves beside the shaft
  std::vector<InputInfo> inputs = {};
  double phase_mark = 0.0;      ///< [rad], on the shaft: the phase counts from it
  double natural_length = 1.0;  ///< [m], scale of the whirl
  /// Its picture at coordinates q and shaft angle [rad]; may be empty.
  std::function<Sketch(const Eigen::VectorXd& q, double angle)> sketch = {};
};

class LinearRotorDynamics final : public Dynamics {
 public:
  /// Throws InputError for matrices of the wrong size and for a mass matrix that is not
  /// positive definite.
  LinearRotorDynamics(RotorDescription description, LinearRotor rotor);

  std::string model() const override { return description_.model; }
  int dof() const override { return static_cast<int>(description_.coordinates.size()); }
  std::vector<CoordinateInfo> coordinates() const override { return description_.coordinates; }
  std::vector<InputInfo> inputs() const override { return description_.inputs; }
  bool linear() const override { return true; }
  bool hasShaft() const override { return true; }
  bool isRotor() const override { return true; }
  bool speedDependent() const override { return rotor_.speed_dependent; }
  double phaseMark() const override { return description_.phase_mark; }
  double naturalLength() const override { return description_.natural_length; }
  const Dynamics& atMeanLoad() const override { return balanced_ ? *balanced_ : *this; }
  std::vector<Station> stations() const override { return description_.stations; }
  std::vector<Station> casing() const override { return description_.casing; }
  LinearRotor linearRotor() const override { return rotor_; }

  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override;
  Eigen::VectorXd residualForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                const EvaluationPoint<double>& at) const override;
  Eigen::VectorXd appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override;
  Eigen::MatrixXd massMatrix(const Eigen::VectorXd&, const Eigen::VectorXd&,
                             const EvaluationPoint<double>&) const override {
    return mass_;
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
  /// That tables of its bearings and pedestals cover the speed.
  std::vector<Condition> conditions(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                    const Eigen::VectorXd& a,
                                    const EvaluationPoint<double>& at) const override;
  std::string singularMass() const override { return ""; }
  Sketch sketch(const Eigen::VectorXd& q, const EvaluationPoint<double>& at) const override {
    return description_.sketch ? description_.sketch(q, at.angle) : Sketch{};
  }

 private:
  RotorDescription description_;
  LinearRotor rotor_;
  Eigen::MatrixXd mass_;
  Cholesky mass_factor_;
  std::unique_ptr<const LinearRotorDynamics> balanced_;  // none: no synchronous force
};

}  // namespace whirl_twin
