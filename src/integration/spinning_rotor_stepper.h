// A linear rotor whose shaft a motor turns (mechanics/spinning_rotor.h): its whirl by the exact
// step along the course of the speed, the spin with it (forced_rotor_step.h). Prepared for a range
// of speeds; beyond it the step is kOutOfRange.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "integration/forced_rotor_step.h"
#include "integration/step_context.h"
#include "integration/step_error_sum.h"
#include "integration/step_parts.h"
#include "integration/stepper.h"
#include "mechanics/spinning_rotor.h"

namespace whirl_twin {

class SpinningRotorStepper final : public Stepper {
 public:
  /// `substeps` in a step [s] of the twin, at speeds [rad/s] from speeds.first to speeds.second.
  SpinningRotorStepper(std::shared_ptr<const SpinningRotor> dynamics, const StepContext& excitation,
                       double step, int substeps, const std::pair<double, double>& speeds);

  StepStatus step(double time) noexcept override;
  StepStatus stepPart(double time, std::int64_t from, std::int64_t to) noexcept override;
  std::size_t dof() const noexcept override { return static_cast<std::size_t>(state_.dof()) + 1; }
  void motion(double* out) const noexcept override;
  void write(double* out) const noexcept override;
  bool shaft(ShaftState& out) const noexcept override {
    out = {spin_.shaftAngle(), spin_.speed.high, spin_.acceleration};
    return true;
  }
  double errorSum() const noexcept override { return errors_.sum(); }
  void set(const double* q, const double* v) noexcept override;
  void exchange(StateImage& image) noexcept override { image(state_, spin_, method_, errors_); }

 private:
  void estimateError() noexcept;

  std::shared_ptr<const SpinningRotor> dynamics_;
  double step_;  ///< [s]
  int substeps_;
  RotorForcing forcing_;
  ForcedRotorStep method_;
  ForcedRotorStep halves_;  ///< of half the length
  StepParts<ForcedRotorStep> parts_;
  ShaftSpin free_;
  LinearMotion state_;
  LinearMotion next_;
  LinearMotion finer_;  ///< next_, by halves
  SpinMotion spin_, next_spin_, finer_spin_;
  std::vector<char> angular_;              ///< of each coordinate
  std::vector<double> start_rates_;        ///< before a step
  std::vector<double> taken_, in_halves_;  ///< q and v after it
  StepErrorSum errors_{kLinearErrorEvery, false};
};

}  // namespace whirl_twin
