#include "mechanics/locally_forced_rotor.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace whirl_twin {

namespace {

constexpr double kWithinRoom = 0.1;  // a whirl that is large

Eigen::Vector2d placeOf(const LocalForce& force, const Eigen::VectorXd& q) {
  return {force.along_x.dot(q), force.along_y.dot(q)};
}

LocalState stateOf(const LocalForce& force, const Eigen::VectorXd& q) {
  LocalState at;
  at.place = {force.along_x.dot(q), force.along_y.dot(q)};
  return at;
}

}  // namespace

LocallyForcedRotor::LocallyForcedRotor(std::shared_ptr<const Dynamics> linear,
                                       std::vector<LocalForce> forces)
    : linear_(std::move(linear)), forces_(std::move(forces)) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dof());
  mass_.compute(linear_->massMatrix(zero, zero, {}));
  const Dynamics& balanced = linear_->atMeanLoad();
  if (&balanced != linear_.get()) {
    balanced_ = std::make_unique<LocallyForcedRotor>(
        std::shared_ptr<const Dynamics>(linear_, &balanced), forces_);
  }
}

double LocallyForcedRotor::naturalLength() const {
  double length = linear_->naturalLength();
  for (const LocalForce& force : forces_) {
    length = std::max(length, kWithinRoom * force.law->room(Eigen::Vector2d::Zero()));
  }
  return length;
}

Eigen::VectorXd LocallyForcedRotor::localForce(const Eigen::VectorXd& q) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(q.size());
  for (const LocalForce& force : forces_) {
    LocalPush push;
    if (!force.law->push(stateOf(force, q), push)) {
      push.force.fill(std::numeric_limits<double>::quiet_NaN());
    }
    sum += push.force[0] * force.along_x + push.force[1] * force.along_y;
  }
  return sum;
}

Eigen::VectorXd LocallyForcedRotor::acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                 const Moment<double>& at) const {
  return mass_.solve(unbalancedForce(q, v, at));
}

Eigen::VectorXd LocallyForcedRotor::unbalancedForce(const Eigen::VectorXd& q,
                                                    const Eigen::VectorXd& v,
                                                    const Moment<double>& at) const {
  return linear_->unbalancedForce(q, v, at) + localForce(q);
}

Eigen::VectorXd LocallyForcedRotor::appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                 const Moment<double>& at) const {
  return linear_->appliedForce(q, v, at) + localForce(q);
}

Energies LocallyForcedRotor::energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                      const Moment<double>& at) const {
  Energies e = linear_->energies(q, v, at);
  e.input_power += v.dot(localForce(q));
  return e;
}

Linearization LocallyForcedRotor::linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                const Eigen::VectorXd& a,
                                                const Moment<double>& at) const {
  Linearization l = linear_->linearization(q, v, a, at);
  for (const LocalForce& force : forces_) {
    Eigen::MatrixXd along(q.size(), 2);
    along << force.along_x, force.along_y;
    const Eigen::MatrixXd k =
        along * force.law->slopes(stateOf(force, q)).stiffness * along.transpose();
    l.stiffness += 0.5 * (k + k.transpose());
    l.circulatory += 0.5 * (k - k.transpose());
  }
  return l;
}

std::vector<Condition> LocallyForcedRotor::conditions(const Eigen::VectorXd& q,
                                                      const Eigen::VectorXd& v,
                                                      const Eigen::VectorXd& a,
                                                      const Moment<double>& at) const {
  std::vector<Condition> all = linear_->conditions(q, v, a, at);
  for (const LocalForce& force : forces_) {
    all.push_back({"gap_" + force.name, "m", force.law->room(placeOf(force, q)),
                   "the rotor touches " + force.name});
  }
  return all;
}

}  // namespace whirl_twin
