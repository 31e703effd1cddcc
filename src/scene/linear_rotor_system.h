// A linear rotor given by its matrices as a system that steps, and the setup of a model made so.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "integration/rotor_step.h"
#include "mechanics/dynamics.h"
#include "scene/model_info.h"
#include "scene/system.h"

namespace whirl_twin {

class LinearRotorSystem final : public System {
 public:
  /// Steps with `exponential`, `substeps` in a step [s] of the twin, on a drive that outlives it,
  /// at the speeds of the drive's profile.
  LinearRotorSystem(std::shared_ptr<const Dynamics> dynamics, const Drive& drive, double step,
                    int substeps);

  StepStatus step(double time) noexcept override;
  std::size_t dof() const noexcept override { return static_cast<std::size_t>(state_.q.size()); }
  void write(double* out) const noexcept override;
  void set(const double* q, const double* v) noexcept override;
  std::unique_ptr<System> readyFor(double lowest_speed, double highest_speed) const override;

 private:
  LinearRotorSystem(std::shared_ptr<const Dynamics> dynamics, const Drive& drive, double step,
                    int substeps, const std::pair<double, double>& speeds,
                    std::vector<double> constant_speeds);

  std::shared_ptr<const Dynamics> dynamics_;
  const Drive& drive_;
  double step_;  ///< [s]
  int substeps_;
  std::vector<double> constant_speeds_;  ///< [rad/s]
  RotorStep method_;
  LinearMotion state_;
  LinearMotion next_;
};

/// The setup of a model whose dynamics are a linear rotor: it steps with `exponential`, at constant
/// and at changing speed.
ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics);

/// A setup of a linear model with a shaft, in the fixed frame, whose `exponential` follows a
/// changing speed by that step where its matrices change with speed; else as it was.
ModelSetup withExactRunUps(ModelSetup setup);

}  // namespace whirl_twin
