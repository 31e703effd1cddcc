// A linear system given by its matrices, stepped by any of the methods for such.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "integration/acting_inputs.h"
#include "integration/linear_step.h"
#include "integration/step_error_sum.h"
#include "integration/step_parts.h"
#include "integration/stepper.h"
#include "mechanics/linear_dynamics.h"

namespace whirl_twin {

/// Is every number of a motion finite? Real-time safe.
bool isFinite(const LinearMotion& motion) noexcept;
/// q, v and the work, one after the other. Real-time safe.
void write(const LinearMotion& motion, double* out) noexcept;

/// The directions of inputs side by side [n x m].
Eigen::MatrixXd directionsOf(const std::vector<InputInfo>& inputs, Eigen::Index n);

class LinearStepper final : public Stepper {
 public:
  /// step [s] of the twin, made of `substeps` steps of one of linearMethodNames(). `inputs`, those
  /// of the model, outlive it; nullptr: nothing acts.
  LinearStepper(const LinearModel& model, const std::string& method, double step, int substeps,
                const Inputs* inputs = nullptr);

  StepStatus step(double time) noexcept override;
  /// Exact, whatever the method.
  StepStatus stepPart(double time, std::int64_t from, std::int64_t to) noexcept override;
  std::size_t dof() const noexcept override { return static_cast<std::size_t>(state_.dof()); }
  void motion(double* out) const noexcept override;
  void write(double* out) const noexcept override;
  double errorSum() const noexcept override { return errors_.sum(); }
  void set(const double* q, const double* v) noexcept override;
  void exchange(StateImage& image) noexcept override { image(state_, errors_); }

 private:
  void estimateError(double time) noexcept;

  ActingInputs inputs_;
  LinearStep method_;
  LinearStep halves_;  ///< of half the length
  StepParts<LinearStep> parts_;
  double substep_;  ///< [s]
  int substeps_;
  std::int64_t step_;  ///< [ns], of the twin
  LinearMotion state_;
  LinearMotion next_;
  LinearMotion finer_;         ///< next_, by halves
  std::vector<char> angular_;  ///< of each coordinate
  StepErrorSum errors_{kLinearErrorEvery};
};

}  // namespace whirl_twin
