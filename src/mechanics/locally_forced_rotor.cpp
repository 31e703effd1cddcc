#include "mechanics/locally_forced_rotor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/constants.h"
#include "algebra/dense.h"

namespace whirl_twin {

namespace {

Eigen::Vector2d placeOf(const LocalForce& force, const Eigen::VectorXd& q) {
  return {force.along_x.dot(q), force.along_y.dot(q)};
}

/// [m], how far the loads bend a rotor that these forces hold where it is.
double sagBetween(const Dynamics& linear, const std::vector<LocalForce>& forces) {
  const LinearRotor rotor = linear.linearRotor();
  Eigen::MatrixXd stiffness = rotor.matrices(0.0).stiffness;
  const double rigid = stiffness.cwiseAbs().maxCoeff();
  for (const LocalForce& force : forces) {
    stiffness += rigid * (force.along_x * force.along_x.transpose() +
                          force.along_y * force.along_y.transpose());
  }
  const Eigen::VectorXd sag = Lu(stiffness).solve(rotor.load);
  double farthest = 0.0;
  for (const Station& station : linear.stations()) {
    farthest = std::max(farthest, std::hypot(station.along_x.dot(sag), station.along_y.dot(sag)));
  }
  return std::isfinite(farthest) ? farthest : 0.0;
}

}  // namespace

LocallyForcedRotor::LocallyForcedRotor(std::shared_ptr<const Dynamics> linear,
                                       std::vector<LocalForce> forces)
    : linear_(std::move(linear)),
      forces_(std::move(forces)),
      natural_length_(std::max(linear_->naturalLength(), sagBetween(*linear_, forces_))) {
  for (const LocalForce& force : forces_) {
    natural_length_ = std::max(natural_length_, force.law->length());
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dof());
  mass_ = Cholesky(linear_->massMatrix(zero, zero, {}));
  const Dynamics& balanced = linear_->atMeanLoad();
  if (&balanced != linear_.get()) {
    balanced_ = std::make_unique<LocallyForcedRotor>(
        std::shared_ptr<const Dynamics>(linear_, &balanced), forces_);
  }
}

Eigen::VectorXd LocallyForcedRotor::localForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                               double speed) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(q.size());
  for (const LocalForce& force : forces_) {
    NodalForce push;
    if (!force.law->push(stateOf(force, q, v, speed), push)) {
      push.force.fill(kNaN);
    }
    sum += push.force[0] * force.along_x + push.force[1] * force.along_y;
  }
  return sum;
}

Eigen::VectorXd LocallyForcedRotor::acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                 const EvaluationPoint<double>& at) const {
  return mass_.solve(residualForce(q, v, at));
}

Eigen::VectorXd LocallyForcedRotor::residualForce(const Eigen::VectorXd& q,
                                                  const Eigen::VectorXd& v,
                                                  const EvaluationPoint<double>& at) const {
  return linear_->residualForce(q, v, at) + localForce(q, v, at.speed);
}

Eigen::VectorXd LocallyForcedRotor::appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                 const EvaluationPoint<double>& at) const {
  return linear_->appliedForce(q, v, at) + localForce(q, v, at.speed);
}

Energies LocallyForcedRotor::energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                      const EvaluationPoint<double>& at) const {
  Energies e = linear_->energies(q, v, at);
  e.input_power += v.dot(localForce(q, v, at.speed));
  return e;
}

Linearization LocallyForcedRotor::linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                const Eigen::VectorXd& a,
                                                const EvaluationPoint<double>& at) const {
  Linearization l = linear_->linearization(q, v, a, at);
  for (const LocalForce& force : forces_) {
    Eigen::MatrixXd along(q.size(), 2);
    along << force.along_x, force.along_y;
    const LocalSlopes slopes = force.law->slopes(stateOf(force, q, v, at.speed));
    const Eigen::MatrixXd k = along * slopes.stiffness * along.transpose();
    const Eigen::MatrixXd c = along * slopes.damping * along.transpose();
    l.stiffness += 0.5 * (k + k.transpose());
    l.circulatory += 0.5 * (k - k.transpose());
    l.damping += 0.5 * (c + c.transpose());
    l.gyroscopic += 0.5 * (c - c.transpose());
  }
  return l;
}

std::vector<Condition> LocallyForcedRotor::conditions(const Eigen::VectorXd& q,
                                                      const Eigen::VectorXd& v,
                                                      const Eigen::VectorXd& a,
                                                      const EvaluationPoint<double>& at) const {
  std::vector<Condition> all = linear_->conditions(q, v, a, at);
  for (const LocalForce& force : forces_) {
    const double room = force.law->room(placeOf(force, q));
    if (room < kInfinity) {
      all.push_back({"gap_" + force.name, "m", room, "the rotor touches " + force.name});
    }
  }
  return all;
}

}  // namespace whirl_twin
