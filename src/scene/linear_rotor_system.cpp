#include "scene/linear_rotor_system.h"

#include <algorithm>
#include <utility>

#include "integration/exponential.h"
#include "scene/linear_stepped_system.h"

namespace whirl_twin {

LinearRotorSystem::LinearRotorSystem(std::shared_ptr<const Dynamics> dynamics,
                                     JacobiIntegral jacobi, const Drive& drive, double step,
                                     int substeps)
    : LinearRotorSystem(std::move(dynamics), std::move(jacobi), drive, step, substeps,
                        drive.speedRange(), drive.constantSpeeds()) {}

LinearRotorSystem::LinearRotorSystem(std::shared_ptr<const Dynamics> dynamics,
                                     JacobiIntegral jacobi, const Drive& drive, double step,
                                     int substeps, const std::pair<double, double>& speeds,
                                     std::vector<double> constant_speeds)
    : dynamics_(std::move(dynamics)),
      jacobi_(std::move(jacobi)),
      drive_(drive),
      step_(step),
      substeps_(substeps),
      constant_speeds_(std::move(constant_speeds)),
      at_rest_(dynamics_->linearRotor().matrices(0.0)),
      load_(dynamics_->linearRotor().load),
      method_(dynamics_->linearRotor(), step / substeps, speeds, constant_speeds_),
      state_(dynamics_->dof()),
      next_(dynamics_->dof()) {}

/// The dynamics' Jacobi integral less T + V of the matrices.
double LinearRotorSystem::furtherEnergy() const noexcept {
  if (!jacobi_) {
    return 0.0;
  }
  const ShaftMotion shaft = drive_.at(0.0);
  double energy = jacobi_(state_.q.data(), state_.v.data(),
                          {0.0, shaft.angle, shaft.speed, shaft.acceleration});
  for (Eigen::Index i = 0; i < state_.q.size(); ++i) {
    energy -= 0.5 * state_.v[i] * at_rest_.mass.col(i).dot(state_.v) +
              0.5 * state_.q[i] * at_rest_.stiffness.col(i).dot(state_.q) - load_[i] * state_.q[i];
  }
  return energy;
}

StepStatus LinearRotorSystem::step(double) noexcept {
  next_ = state_;
  for (int i = 0; i < substeps_; ++i) {
    const StepStatus status = method_.advance(drive_, i * (step_ / substeps_), next_);
    if (status != StepStatus::kOk) {
      return status;
    }
  }
  if (!isFinite(next_)) {
    return StepStatus::kNotFinite;
  }
  std::swap(state_, next_);
  return StepStatus::kOk;
}

void LinearRotorSystem::write(double* out) const noexcept {
  whirl_twin::write(state_, out);
  out[2 * dof()] += furtherEnergy() - further_energy_;
}

void LinearRotorSystem::set(const double* q, const double* v) noexcept {
  state_.set(q, v);
  method_.restart();
  further_energy_ = furtherEnergy();
}

std::unique_ptr<System> LinearRotorSystem::readyFor(double lowest_speed,
                                                    double highest_speed) const {
  std::vector<double> constant_speeds = constant_speeds_;
  for (const double speed : {lowest_speed, highest_speed}) {
    if (std::find(constant_speeds.begin(), constant_speeds.end(), speed) == constant_speeds.end()) {
      constant_speeds.push_back(speed);
    }
  }
  const bool covered =
      method_.lowestSpeed() <= lowest_speed && method_.highestSpeed() >= highest_speed;
  if (covered && constant_speeds.size() == constant_speeds_.size()) {
    return nullptr;
  }
  const std::pair<double, double> speeds{std::min(lowest_speed, method_.lowestSpeed()),
                                         std::max(highest_speed, method_.highestSpeed())};
  return std::unique_ptr<System>(new LinearRotorSystem(dynamics_, jacobi_, drive_, step_, substeps_,
                                                       speeds, std::move(constant_speeds)));
}

namespace {

ModelSetup exactSetup(std::shared_ptr<const Dynamics> dynamics, const JacobiIntegral& jacobi) {
  ModelSetup setup;
  setup.dynamics = dynamics;
  setup.integrators = {Exponential<1>::kName};
  setup.system = [dynamics, jacobi](const std::string&, const Drive& drive, double step,
                                    int substeps) {
    return std::make_unique<LinearRotorSystem>(dynamics, jacobi, drive, step, substeps);
  };
  setup.exact_run_ups = true;
  return setup;
}

}  // namespace

ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics) {
  return exactSetup(std::move(dynamics), {});
}

ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi) {
  if (!setup.dynamics->linear() || !setup.dynamics->speedDependent()) {
    return setup;
  }
  setup.system = [plain = setup.system, exact = exactSetup(setup.dynamics, jacobi).system](
                     const std::string& integrator, const Drive& drive, double step, int substeps) {
    const bool exponential = integrator == Exponential<1>::kName;
    return (exponential ? exact : plain)(integrator, drive, step, substeps);
  };
  setup.exact_run_ups = true;
  return setup;
}

}  // namespace whirl_twin
