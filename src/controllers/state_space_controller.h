// A linear discrete-time controller in state space, of the measurement minus its set-point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "controllers/controller.h"

namespace whirl_twin {

/// u = gain y, without states.
DiscreteStateSpace staticLaw(const Eigen::MatrixXd& gain);

class StateSpaceController final : public Controller {
 public:
  /// setpoint: one number for each measured quantity.
  StateSpaceController(DiscreteStateSpace law, Eigen::VectorXd setpoint);

  void reset() noexcept override { state_.setZero(); }
  void exchange(StateImage& image) noexcept override { image(state_); }
  void update(const ControlSample& sample, double* outputs) noexcept override;
  /// Copies the state of one with the same number of states.
  void takeOver(const Controller& before) noexcept override;
  std::optional<DiscreteStateSpace> linear(double) const override { return law_; }
  std::vector<double> setpoint() const override {
    return {setpoint_.data(), setpoint_.data() + setpoint_.size()};
  }

 private:
  DiscreteStateSpace law_;
  Eigen::VectorXd setpoint_;
  Eigen::VectorXd state_;
  Eigen::VectorXd next_;      // work space of update(), preallocated
  Eigen::VectorXd measured_;  // likewise
};

}  // namespace whirl_twin
