#include "controllers/state_space_controller.h"

#include <utility>

namespace whirl_twin {

DiscreteStateSpace staticLaw(const Eigen::MatrixXd& gain) {
  return {Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, gain.cols()), Eigen::MatrixXd(gain.rows(), 0),
          gain};
}

StateSpaceController::StateSpaceController(DiscreteStateSpace law, Eigen::VectorXd setpoint)
    : law_(std::move(law)),
      setpoint_(std::move(setpoint)),
      state_(Eigen::VectorXd::Zero(law_.states())),
      next_(state_),
      measured_(setpoint_.size()) {}

void StateSpaceController::update(const ControlSample& sample, double* outputs) noexcept {
  measured_ = Eigen::Map<const Eigen::VectorXd>(sample.values, measured_.size()) - setpoint_;
  Eigen::Map<Eigen::VectorXd> u(outputs, law_.d.rows());
  u.noalias() = law_.d * measured_;
  u.noalias() += law_.c * state_;
  next_.noalias() = law_.a * state_;
  next_.noalias() += law_.b * measured_;
  state_.swap(next_);
}

void StateSpaceController::takeOver(const Controller& before) noexcept {
  const auto* const other = dynamic_cast<const StateSpaceController*>(&before.law());
  if (other != nullptr && other->state_.size() == state_.size()) {
    state_ = other->state_;
  }
}

}  // namespace whirl_twin
