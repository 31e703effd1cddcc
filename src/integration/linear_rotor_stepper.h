// Exact stepper of a linear rotor given by its matrices, also with nonlinear nodal forces
// (forced_rotor_step.h).
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "integration/forced_rotor_step.h"
#include "integration/jacobi_integral.h"
#include "integration/step_context.h"
#include "integration/step_error_sum.h"
#include "integration/step_parts.h"
#include "integration/stepper.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

class LinearRotorStepper final : public Stepper {
 public:
  /// Steps with `exponential`, `substeps` in a step [s] of the twin, at the speeds of the drive's
  /// profile. The step audits h = T + V of its matrices; where the
  /// dynamics have another Jacobi integral, with the motion of the unbalance in it, `jacobi` is
  /// that, and what it changes by besides is added to the work.
  LinearRotorStepper(std::shared_ptr<const Dynamics> dynamics, JacobiIntegral jacobi,
                     const StepContext& excitation, double step, int substeps,
                     std::vector<LocalForce> forces = {});

  StepStatus step(double time) noexcept override;
  StepStatus stepPart(double time, std::int64_t from, std::int64_t to) noexcept override;
  std::size_t dof() const noexcept override { return static_cast<std::size_t>(state_.dof()); }
  void motion(double* out) const noexcept override;
  void write(double* out) const noexcept override;
  double errorSum() const noexcept override { return errors_.sum(); }
  void set(const double* q, const double* v) noexcept override;
  void exchange(StateImage& image) noexcept override {
    image(state_, method_, errors_, further_energy_, at_start_);
  }
  std::unique_ptr<Stepper> readyFor(double lowest_speed, double highest_speed) const override;

 private:
  LinearRotorStepper(std::shared_ptr<const Dynamics> dynamics, JacobiIntegral jacobi,
                     const StepContext& excitation, double step, int substeps,
                     const std::pair<double, double>& speeds, std::vector<double> constant_speeds,
                     std::vector<LocalForce> forces);
  double furtherEnergy() const noexcept;
  std::int64_t nextCorner(std::int64_t offset) const noexcept;  ///< [ns] after begin()
  void estimateError() noexcept;
  StepStatus startingStep() noexcept;

  std::shared_ptr<const Dynamics> dynamics_;
  JacobiIntegral jacobi_;  ///< may be empty
  StepContext excitation_;
  double step_;  ///< [s]
  int substeps_;
  std::vector<double> constant_speeds_;  ///< [rad/s]
  Linearization audited_;                ///< whose h = T + V the step audits
  Eigen::VectorXd load_;
  double further_energy_ = 0.0;  ///< [J], at the start
  RotorForcing forcing_;
  ForcedRotorStep method_;
  ForcedRotorStep halves_;                 ///< of half the length
  std::vector<ForcedRotorStep> starting_;  ///< shortest first, each twice the one before
  bool at_start_ = false;
  StepParts<ForcedRotorStep> parts_;
  LinearMotion state_;
  LinearMotion next_;
  LinearMotion finer_;         ///< next_, by halves
  std::vector<char> angular_;  ///< of each coordinate
  StepErrorSum errors_{kLinearErrorEvery, false};
};

}  // namespace whirl_twin
