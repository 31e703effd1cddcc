// A linear rotor given by its matrices as a system that steps, and the setup of a model made so.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "integration/rotor_step.h"
#include "mechanics/dynamics.h"
#include "scene/model_info.h"
#include "scene/system.h"

namespace whirl_twin {

/// The Jacobi integral h [J] of a model at a state of dof() numbers each. Real-time safe.
using JacobiIntegral =
    std::function<double(const double* q, const double* v, const Moment<double>& at)>;

class LinearRotorSystem final : public System {
 public:
  /// Steps with `exponential`, `substeps` in a step [s] of the twin, on a drive that outlives it,
  /// at the speeds of the drive's profile. The step audits h = T + V of its matrices; where the
  /// dynamics have another Jacobi integral, with the motion of the unbalance in it, `jacobi` is
  /// that, and what it changes by besides is added to the work.
  LinearRotorSystem(std::shared_ptr<const Dynamics> dynamics, JacobiIntegral jacobi,
                    const Drive& drive, double step, int substeps);

  StepStatus step(double time) noexcept override;
  std::size_t dof() const noexcept override { return static_cast<std::size_t>(state_.q.size()); }
  void write(double* out) const noexcept override;
  void set(const double* q, const double* v) noexcept override;
  std::unique_ptr<System> readyFor(double lowest_speed, double highest_speed) const override;

 private:
  LinearRotorSystem(std::shared_ptr<const Dynamics> dynamics, JacobiIntegral jacobi,
                    const Drive& drive, double step, int substeps,
                    const std::pair<double, double>& speeds, std::vector<double> constant_speeds);
  double furtherEnergy() const noexcept;

  std::shared_ptr<const Dynamics> dynamics_;
  JacobiIntegral jacobi_;  ///< may be empty
  const Drive& drive_;
  double step_;  ///< [s]
  int substeps_;
  std::vector<double> constant_speeds_;  ///< [rad/s]
  Linearization at_rest_;
  Eigen::VectorXd load_;
  double further_energy_ = 0.0;  ///< [J], at the start
  RotorStep method_;
  LinearMotion state_;
  LinearMotion next_;
};

/// The setup of a model whose dynamics are a linear rotor: it steps with `exponential`, at constant
/// and at changing speed.
ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics);

/// A setup of a linear model with a shaft, in the fixed frame, whose `exponential` follows a
/// changing speed by that step where its matrices change with speed; else as it was.
ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi);

/// h = v . dL/dv - L of a model.
template <class Model>
JacobiIntegral jacobiIntegral(const Model& model) {
  return [model](const double* q, const double* v, const Moment<double>& at) {
    std::array<double, Model::kDof> position;
    std::array<double, Model::kDof> rate;
    std::copy_n(q, Model::kDof, position.begin());
    std::copy_n(v, Model::kDof, rate.begin());
    const ByRates<Model::kDof> by_rates(position, rate, at);
    const auto kinetic = model.kinetic(by_rates.q, by_rates.v, by_rates.at);
    double h = model.potential(position, at) - kinetic.value;
    for (std::size_t i = 0; i < Model::kDof; ++i) {
      h += rate[i] * kinetic.slope[i];
    }
    return h;
  };
}

}  // namespace whirl_twin
