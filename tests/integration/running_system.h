// One system on its shaft, stepped as in the twin: the drive begins each step, then the system
// advances. Methods are those compiled into the library, with its flags.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "control/drive.h"
#include "control/inputs.h"
#include "models/model_registry.h"

namespace whirl_twin {

/// The parameters given, the rest at their defaults.
inline ParameterValues completed(const ModelInfo& model, const ParameterValues& given) {
  ParameterValues values = given;
  for (const ParameterInfo& p : model.parameters) {
    if (values.count(p.name) == 0) {
      values[p.name] =
          p.fallback_parameter.empty() ? p.fallback.value() : values.at(p.fallback_parameter);
    }
  }
  if (values.size() != model.parameters.size()) {
    throw std::invalid_argument("a parameter that " + model.name + " does not have");
  }
  return values;
}

class RunningSystem {
 public:
  struct Setup {
    std::string model;
    ParameterValues parameters;
    Settings settings{};
    double gravity = 9.81;  ///< [m/s^2]
    double speed = 0.0;     ///< [rad/s], of the shaft at the start
    std::vector<SpeedMove> profile{};
    std::vector<double> q{};
    std::vector<double> v{};
    std::optional<Motor> motor{};  ///< that turns it; then q and v end with the spin
    std::map<std::string, InputSignal> inputs{};
    int substeps = 1;
  };

  /// step in nanoseconds.
  RunningSystem(const Setup& setup, const std::string& method, std::int64_t step)
      : drive_(setup.speed, 0.0, setup.profile),
        step_(step),
        dynamics_(setUp(setup).dynamics),
        inputs_(signals(*dynamics_, setup.inputs)),
        dof_(static_cast<std::size_t>(dynamics_->dof())),
        record_(2 * dof_ + 1) {
    system_ = setUp(setup).system(method, {drive_, &inputs_}, seconds(step), setup.substeps);
    std::vector<double> q = setup.q;
    std::vector<double> v = setup.v;
    q.resize(dof_);
    v.resize(dof_);
    system_->set(q.data(), v.data());
    drive_.begin(0);
    inputs_.begin(0);
    system_->write(record_.data());
  }
  RunningSystem(const RunningSystem&) = delete;
  RunningSystem& operator=(const RunningSystem&) = delete;

  /// Steps until the first that fails.
  StepStatus run(std::int64_t steps) {
    StepStatus status = StepStatus::kOk;
    for (std::int64_t i = 0; i < steps && status == StepStatus::kOk; ++i) {
      status = system_->step(time());
      if (status == StepStatus::kOk) {
        drive_.begin(++count_ * step_);
        inputs_.begin(count_ * step_);
      }
    }
    system_->write(record_.data());
    return status;
  }

  double time() const { return seconds(count_ * step_); }      ///< [s]
  double q(std::size_t i) const { return record_[i]; }         ///< [rad] or [m]
  double v(std::size_t i) const { return record_[dof_ + i]; }  ///< the rates
  double work() const { return record_[2 * dof_]; }            ///< [J], audited
  const Drive& drive() const { return drive_; }
  /// Sets a constant input from the next step on, until the instant [ns].
  bool command(const std::string& input, double value, std::int64_t until) {
    const std::vector<InputInfo> all = dynamics_->inputs();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].name == input) {
        const bool set = inputs_.set(i, value, until);
        inputs_.begin(count_ * step_);
        return set;
      }
    }
    return false;
  }
  const Dynamics& dynamics() const { return *dynamics_; }
  Energies energies() const {
    const ShaftMotion shaft = drive_.at(0.0);
    const auto n = static_cast<Eigen::Index>(dof_);
    return dynamics_->energies(Eigen::Map<const Eigen::VectorXd>(record_.data(), n),
                               Eigen::Map<const Eigen::VectorXd>(record_.data() + n, n),
                               {time(), shaft.angle, shaft.speed, shaft.acceleration});
  }
  std::vector<double> state() const { return {record_.begin(), record_.end() - 1}; }  ///< q, v

 private:
  static ModelSetup setUp(const Setup& setup) {
    const ModelInfo& model = *findModel(setup.model);
    ModelContext around(setup.gravity);
    around.motor = setup.motor;
    return model.setUp(completed(model, setup.parameters), setup.settings, around);
  }
  static std::vector<InputSignal> signals(const Dynamics& dynamics,
                                          std::map<std::string, InputSignal> given) {
    std::vector<InputSignal> all;
    for (const InputInfo& input : dynamics.inputs()) {
      all.push_back(given[input.name]);
      given.erase(input.name);
    }
    if (!given.empty()) {
      throw std::invalid_argument(dynamics.model() + " has no input " + given.begin()->first);
    }
    return all;
  }
  static double seconds(std::int64_t nanoseconds) {
    return static_cast<double>(nanoseconds) / 1.0e9;
  }

  Drive drive_;
  std::int64_t step_;  // [ns]
  std::int64_t count_ = 0;
  std::shared_ptr<const Dynamics> dynamics_;
  Inputs inputs_;
  std::size_t dof_;
  std::vector<double> record_;
  std::unique_ptr<Stepper> system_;
};

}  // namespace whirl_twin
