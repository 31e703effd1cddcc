// Interface of a model for analysis, display and checking. (Steps do not use it: they are composed
// with their model at compile time.)
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "mechanics/energies.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/linear_rotor.h"
#include "mechanics/linearization.h"
#include "mechanics/reaction.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

/// A coordinate of a model as set up: its name may come from the scene.
struct CoordinateInfo {
  std::string name;          ///< as in scene files; its rate is NAME_rate
  std::string unit;          ///< "rad" or "m"
  std::string meaning = "";  ///< of what, from where, and which way is positive; "": not stated
  bool isAngle() const { return unit == "rad"; }
};

/// An input of a model as set up.
struct InputInfo {
  std::string name;           ///< as in scene files
  std::string unit;           ///< of its value u
  Eigen::VectorXd direction;  ///< the generalized force is u times it
  std::string meaning;
};

/// A model with its parameters. Vectors are of size dof(), in the order of coordinates().
class Dynamics {
 public:
  virtual ~Dynamics() = default;

  virtual std::string model() const = 0;
  virtual int dof() const = 0;
  virtual std::vector<CoordinateInfo> coordinates() const = 0;
  /// What may act on it from outside besides.
  virtual std::vector<InputInfo> inputs() const { return {}; }
  virtual bool linear() const = 0;          ///< equations linear in q and v
  virtual bool hasShaft() const = 0;        ///< the motion of a shaft enters
  virtual bool isRotor() const = 0;         ///< x, y of a whirling disc
  virtual bool speedDependent() const = 0;  ///< the matrices of a linear model change with speed
  virtual double phaseMark() const = 0;     ///< [rad], on a rotor's shaft: its phase counts from it
  virtual double naturalLength() const = 0;  ///< [m], scale of the sliding coordinates
  /// The same system without alternating loads and, for a rotor, without synchronous forces: its
  /// equilibria are those at rest.
  virtual const Dynamics& atMeanLoad() const = 0;
  /// Of the loads, supports and coefficients that alternate with time [rad/s], each > 0; empty:
  /// nothing does, or it is not known how.
  virtual std::vector<double> loadFrequencies() const { return {}; }

  virtual Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                       const EvaluationPoint<double>& at) const = 0;
  /// The residual generalized force at zero acceleration: zero in a steady motion, and with v = 0
  /// at an equilibrium.
  virtual Eigen::VectorXd residualForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                        const EvaluationPoint<double>& at) const = 0;
  /// The forces that have no potential, Q - dD/dv.
  virtual Eigen::VectorXd appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                       const EvaluationPoint<double>& at) const = 0;
  virtual Eigen::MatrixXd massMatrix(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                     const EvaluationPoint<double>& at) const = 0;
  /// Generalized momenta dL/dv.
  virtual Eigen::VectorXd momenta(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                  const EvaluationPoint<double>& at) const = 0;
  virtual Energies energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                            const EvaluationPoint<double>& at) const = 0;
  virtual Linearization linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                      const Eigen::VectorXd& a,
                                      const EvaluationPoint<double>& at) const = 0;

  /// Constraint forces, at a state whose accelerations are a.
  virtual std::vector<Reaction> reactions(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                          const Eigen::VectorXd& a,
                                          const EvaluationPoint<double>& at) const = 0;
  /// Conditions under which the equations hold, at a state whose accelerations are a.
  virtual std::vector<Condition> conditions(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                            const Eigen::VectorXd& a,
                                            const EvaluationPoint<double>& at) const = 0;
  /// The contacts whose dry friction can hold, at a state under the generalized force `applied`
  /// from outside. acceleration() has held contacts hold, without that force.
  virtual std::vector<DryHold> dryHolds(const Eigen::VectorXd& /*q*/, const Eigen::VectorXd& /*v*/,
                                        const Eigen::VectorXd& /*applied*/,
                                        const EvaluationPoint<double>& /*at*/) const {
    return {};
  }
  /// Why the mass matrix can become singular; "" where it cannot.
  virtual std::string singularMass() const = 0;
  /// Where along its shaft a rotor's whirl is seen, the place that is published first; empty for
  /// anything else.
  virtual std::vector<Station> stations() const { return {}; }
  /// What moves beside the shaft: its pedestals.
  virtual std::vector<Station> casing() const { return {}; }
  /// The stations, then the casing: a sensor may measure at any of them.
  std::vector<Station> places() const {
    std::vector<Station> all = stations();
    const std::vector<Station> beside = casing();
    all.insert(all.end(), beside.begin(), beside.end());
    return all;
  }
  /// The matrices and forces of a linear model as functions of the speed of its shaft, if it has
  /// one. Throws std::logic_error for any other and for one whose loads alternate by themselves.
  virtual LinearRotor linearRotor() const;
  /// Its picture; empty where there is none.
  virtual Sketch sketch(const Eigen::VectorXd& q, const EvaluationPoint<double>& at) const = 0;
};

}  // namespace whirl_twin
