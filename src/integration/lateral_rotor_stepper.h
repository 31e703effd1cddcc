// A rotor of two coordinates (lateral_rotor.h) on its drive: the plain exact step at constant
// speed, quadrature at Gauss nodes while it changes. It is ready for any speed.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "integration/lateral_exact_step.h"
#include "integration/lateral_rotor.h"
#include "integration/lateral_run_up.h"
#include "integration/step_context.h"
#include "integration/stepper.h"

namespace whirl_twin {

class LateralRotorStepper : public Stepper {
 public:
  /// A stepper of this kind for step [s] of the twin in `substeps` sub-steps, or nullptr: the rotor
  /// is of a different kind, or so stiff that a run-up would need very many sub-steps. The step
  /// audits h = T + V of the matrices; the further terms of the Jacobi integral, of the moving
  /// unbalance and the rotating bow, are added to the work when it is requested.
  static std::unique_ptr<Stepper> of(const LinearRotor& rotor, const Drive& drive, double step,
                                     int substeps);

  LateralRotorStepper(const LateralRotor& rotor, const Drive& drive, double step, int substeps);

  /// Unsupported: systems whose steps are divided use a different stepper.
  StepStatus stepPart(double, std::int64_t, std::int64_t) noexcept override {
    return stopped(StepStatus::kOutOfRange);
  }
  std::size_t dof() const noexcept override { return 2; }
  void motion(double* out) const noexcept override {
    std::copy(motion_.y.begin(), motion_.y.end(), out);
  }
  void write(double* out) const noexcept override;
  double errorSum() const noexcept override { return error_sum_; }
  void set(const double* q, const double* v) noexcept override;
  void exchange(StateImage& image) noexcept override {
    image(motion_, exact_, run_up_, further_energy_, last_energy_, steps_since_estimate_,
          largest_place_, largest_rate_, error_sum_);
  }

 protected:
  /// Compiled for each width of vectors.
  template <int lanes>
  WHIRL_TWIN_INLINE StepStatus take() noexcept {
    StepStatus status;
    if (__builtin_expect(exact_.goesOn<lanes>(drive_, motion_, status), 1)) {
      return __builtin_expect(status == StepStatus::kOk, 1) ? status : stopped(status);
    }
    return otherStep();
  }

 private:
  StepStatus otherStep() noexcept;
  /// Stops the rotor while the shaft continues: the further terms of its energy are frozen at their
  /// present values.
  StepStatus stopped(StepStatus why) noexcept;
  StepStatus changingStep() noexcept;
  StepStatus advance(double offset, double h, LateralMotion& motion) noexcept;
  void estimateError(const LateralMotion& end) noexcept;
  double shaftSpeed() const noexcept;
  double furtherEnergy() const noexcept;

  const Drive& drive_;
  double step_;  ///< [s]
  LateralMotion motion_;
  LateralExactStep exact_;
  LateralRunUp run_up_;
  LateralRotor rotor_;
  bool energy_turns_;
  int substeps_;
  double further_energy_ = 0.0;             ///< [J], at the start
  std::optional<double> last_energy_ = {};  ///< [J], of one that has stopped
  int steps_since_estimate_ = 0;
  double largest_place_ = 0.0, largest_rate_ = 0.0;  ///< so far
  double error_sum_ = 0.0;
};

}  // namespace whirl_twin
