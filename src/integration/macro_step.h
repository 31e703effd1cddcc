// Macro-steps with dense output: a method takes longer steps than the twin while no external input
// acts, and the states at the twin's steps are interpolated.
//
// One step of the method is as long as `count` of the twin's. It is taken at the first of them; the
// others cost almost nothing: only requested states are interpolated, by the polynomial of the step
// (stoermer.h). The most expensive step of the twin is the one that builds the multistep history
// (ten evaluations and nine steps of dormand_prince_8).
//
// Where the shaft's speed changes the twin's steps are used, and for a while after a macro-step did
// not resolve the motion, as after a change of parameters. A command, a breakpoint or a new state
// ends a macro-step there: integration continues from the interpolated state.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "control/drive.h"
#include "integration/motion_state.h"
#include "integration/stepper.h"
#include "integration/stoermer_weights.h"

namespace whirl_twin {

/// A stepper whose last step can be read off inside, if its method can be.
class ReadOffStepper : public Stepper {
 public:
  /// q, v and, if requested, the work of the last step at a fraction of it, in the format of
  /// write().
  virtual void readOff(const DenseOutputWeights& reading, bool with_work,
                       double* out) const noexcept = 0;
  /// Whether the last step resolved the motion.
  virtual bool follows() const noexcept = 0;
};

class MacroStep final : public Stepper {
 public:
  /// Two steppers of one system: `far` by `count` steps of the twin at once, at most kMaxSteps,
  /// which together last `length` [s], `near` by one. `drive` of a system with a shaft, else
  /// nullptr; it outlives this.
  MacroStep(std::unique_ptr<ReadOffStepper> far, std::unique_ptr<Stepper> near,
            const StoermerScheme& scheme, const Drive* drive, double length, int count);

  static constexpr int kMaxSteps = 256;

  StepStatus step(double time) noexcept override {
    if (__builtin_expect(passed_ < count_ && (drive_ == nullptr || drive_->piece() == piece_), 1)) {
      ++passed_;
      return StepStatus::kOk;
    }
    return begin(time);
  }
  StepStatus stepPart(double time, std::int64_t from, std::int64_t to) noexcept override;
  std::size_t dof() const noexcept override { return far_->dof(); }
  void motion(double* out) const noexcept override;
  void write(double* out) const noexcept override;
  double errorSum() const noexcept override;
  void set(const double* q, const double* v) noexcept override;
  void exchange(StateImage& image) noexcept override;

 private:
  StepStatus begin(double time) noexcept;
  bool mayStepFar() const noexcept;
  void keep() noexcept;
  void advanceBy(bool far) noexcept;

  std::unique_ptr<ReadOffStepper> far_;
  std::unique_ptr<Stepper> near_;
  std::vector<DenseOutputWeights> readings_;  ///< after 1, 2 ... steps of the twin
  const Drive* drive_;
  double length_;  ///< [s]
  int count_;
  bool by_far_ = false;  ///< the state is far_'s
  int near_left_ = 0;    ///< steps of the twin until a long one may be tried again
  /// Steps of the twin in the present macro-step; count_: it is over, or there is none.
  int passed_;
  std::uint64_t piece_ = 0;     ///< of the drive, in which it began
  std::vector<double> state_;   ///< kept: as write(), then the sum of errors
  CompensatedSum work_before_;  ///< [J], of the other stepper's steps
  double errors_before_ = 0.0;  ///< likewise
};

}  // namespace whirl_twin
