// A linear system given by its matrices, stepped by any of the methods for such.
#pragma once

#include <memory>
#include <string>

#include "integration/linear_step.h"
#include "integration/stepper.h"
#include "mechanics/linear_dynamics.h"

namespace whirl_twin {

/// Is every number of a motion finite? Real-time safe.
bool isFinite(const LinearMotion& motion) noexcept;
/// q, v and the work, one after the other. Real-time safe.
void write(const LinearMotion& motion, double* out) noexcept;

class LinearStepper final : public Stepper {
 public:
  /// step [s] of the twin, made of `substeps` steps of one of linearMethodNames().
  LinearStepper(const LinearModel& model, const std::string& method, double step, int substeps);

  StepStatus step(double time) noexcept override;
  std::size_t dof() const noexcept override { return static_cast<std::size_t>(state_.q.size()); }
  void write(double* out) const noexcept override;
  void set(const double* q, const double* v) noexcept override;

 private:
  LinearStep method_;
  double substep_;  ///< [s]
  int substeps_;
  LinearMotion state_;
  LinearMotion next_;
};

}  // namespace whirl_twin
