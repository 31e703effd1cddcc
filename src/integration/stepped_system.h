// Model x method, composed at compile time: compiled only in the translation units of models/, with
// the flags that let the compiler delete a dual's dead terms; or with a ErasedModel in place of the
// model (erased_system.h). The finiteness check reads bits.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>

#include "control/drive.h"
#include "control/shaft_angle.h"
#include "integration/dry_friction_step.h"
#include "integration/finite.h"
#include "integration/input_force.h"
#include "integration/macro_step.h"
#include "integration/method_step.h"
#include "integration/sliver.h"
#include "integration/step_error_sum.h"
#include "integration/stepped_model.h"
#include "integration/stepper.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// A multistep method: its history is discarded where the motion is not smooth.
template <class Method, class = void>
struct HasHistory : std::false_type {};
template <class Method>
struct HasHistory<Method, std::void_t<decltype(Method::kHasHistory)>> : std::true_type {};

template <class Model, class Method>
class SteppedSystem final : public ReadOffStepper {
 public:
  static constexpr std::size_t n = Model::kDof;

  /// step [s] of the twin, made of `substeps` steps of the method. The drive outlives the system.
  SteppedSystem(const Model& model, const Drive& drive, const InputForce& inputs, double step,
                int substeps, const Method& method = Method())
      : model_(model),
        drive_(drive),
        substep_(step / substeps),
        substeps_(substeps),
        method_(method),
        finer_method_(method),
        inputs_(inputs) {}

  StepStatus step(double time) noexcept override { return take(time, 0.0, substeps_, substep_); }
  [[gnu::noinline, gnu::cold]] StepStatus stepPart(double time, std::int64_t from,
                                                   std::int64_t to) noexcept override {
    const double length = static_cast<double>(to - from) / 1e9;
    const double count = std::fmax(1.0, std::ceil(length / substep_ - kSliver));
    method_.restart();
    dry_.restart();
    return take(time, static_cast<double>(from) / 1e9, static_cast<int>(count), length / count);
  }
  double errorSum() const noexcept override { return errors_.sum(); }
  std::size_t dof() const noexcept override { return n; }
  void motion(double* out) const noexcept override {
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = state_.q[i];
      out[n + i] = state_.v[i];
    }
    if (hasSpin()) {
      out[kSpin] = spin().total();
    }
  }
  void write(double* out) const noexcept override {
    motion(out);
    out[2 * n] = state_.work.high;
  }
  /// Of a multistep method, where no spin is a coordinate.
  void readOff([[maybe_unused]] const DenseOutputWeights& reading, [[maybe_unused]] bool with_work,
               [[maybe_unused]] double* out) const noexcept override {
    if constexpr (kHasHistory) {
      method_.readOff(reading, state_, with_work, out);
    }
  }
  bool follows() const noexcept override {
    if constexpr (kHasHistory) {
      return method_.resolves(state_);
    }
    return true;
  }
  bool shaft(ShaftState& out) const noexcept override {
    if (hasSpin()) {
      // No load on a rotor depends on the time by itself.
      auto eom = Form::at(model_, state_.q, state_.v, EvaluationPoint<double>{});
      if (inputs_.acts()) {
        std::array<double, n> applied;
        inputs_.now(applied.data());
        for (std::size_t i = 0; i < n; ++i) {
          eom.force[i] += applied[i];
        }
      }
      out = {spin(), state_.v[kSpin], solveMass<double, n>(eom.mass, eom.force)[kSpin]};
    }
    return hasSpin();
  }
  void set(const double* q, const double* v) noexcept override {
    state_ = MotionState<n>{};
    for (std::size_t i = 0; i < n; ++i) {
      state_.q[i] = q[i];
      state_.v[i] = v[i];
    }
    turns_ = 0;
    if (hasSpin() && isFinite(q[kSpin]) && std::fabs(q[kSpin]) < kMaxStart) {
      const ShaftAngle angle = shaftAngle(q[kSpin]);
      turns_ = angle.turns;
      state_.q[kSpin] = angle.remainder;
    }
    method_.restart();
    dry_.restart();
    errors_.restart();
  }
  void exchange(StateImage& image) noexcept override {
    image(method_, finer_method_, state_, errors_, turns_);
    if constexpr (Form::kMayStick) {
      if (Form::sticks(model_)) {
        image(dry_);
      }
    }
  }

 private:
  using Form = SteppedModel<Model>;
  using Equation = typename Form::Equation;
  using Step = MethodStep<Model, Method>;

  static constexpr bool kHasHistory = HasHistory<Method>::value;
  static constexpr std::size_t kSpin = n - 1;

  WHIRL_TWIN_INLINE bool hasShaft() const noexcept { return Form::hasShaft(model_); }
  WHIRL_TWIN_INLINE bool hasSpin() const noexcept { return Form::hasSpin(model_); }

  /// `count` steps of the method of h [s] each, from an offset [s] after `time` [s] on.
  WHIRL_TWIN_INLINE StepStatus take(double time, double offset, int count, double h) noexcept {
    const Equation equation = Form::equation(model_, drive_, time);
    if constexpr (kHasHistory) {
      if (hasShaft()) {
        const ShaftMotion shaft = drive_.withoutAngle(0.0);  // a command may have changed it
        method_.follow(shaft.jerk, shaft.acceleration);
      }
    }
    const MotionState<n> start = state_;
    for (int i = 0; i < count; ++i) {
      const StepStatus status = advance(method_, equation, offset + i * h, h, state_);
      if (__builtin_expect(status != StepStatus::kOk, 0)) {
        return goBack(start, finite(start) ? status : StepStatus::kNotFinite);
      }
    }
    if (__builtin_expect(!finite(state_), 0)) {
      return goBack(start, StepStatus::kNotFinite);
    }
    if (__builtin_expect(!hasPhase(state_), 0)) {
      return goBack(start, StepStatus::kOutOfRange);
    }
    if (__builtin_expect(errors_.countStep(), 0)) {
      estimateError(equation, offset, count, h, start);
    }
    wholeTurns();
    return StepStatus::kOk;
  }
  /// The state was restored: the history of the method belongs to a different motion.
  [[gnu::noinline, gnu::cold]] StepStatus goBack(const MotionState<n>& start,
                                                 StepStatus why) noexcept {
    state_ = start;
    dry_.restart();
    if constexpr (kHasHistory) {
      method_.restart();
    }
    return why;
  }

  static WHIRL_TWIN_INLINE bool finite(const MotionState<n>& state) noexcept {
    bool all = isFinite(state.work.high);
    for (std::size_t i = 0; i < n; ++i) {
      all = all && isFinite(state.q[i]) && isFinite(state.v[i]);
    }
    return all;
  }

  /// A larger angle in one step has no significant phase in a double.
  WHIRL_TWIN_INLINE bool hasPhase(const MotionState<n>& state) const noexcept {
    return !hasSpin() || std::fabs(state.q[kSpin]) < kMaxTurned;
  }

  /// The spin is stepped as whole turns and a remainder, so that its phase is as exact after a
  /// month as after a second; 2 pi is subtracted with 106 bits.
  WHIRL_TWIN_INLINE void wholeTurns() noexcept {
    if (!hasSpin()) {
      return;
    }
    double& angle = state_.q[kSpin];
    if (angle >= 0.0 && angle < kTwoPi) {
      return;
    }
    const double turns = std::floor(angle / kTwoPi);
    const double whole = turns * kTwoPi;
    const double error = std::fma(turns, kTwoPi, -whole) + turns * kTwoPiLow;
    CompensatedSum rest{angle - whole, state_.q_low[kSpin]};
    rest.add(-error);
    angle = rest.high;
    state_.q_low[kSpin] = rest.low;
    turns_ += static_cast<std::int64_t>(turns);
  }
  ShaftAngle spin() const noexcept {
    const double angle = state_.q[kSpin];
    return {turns_, angle < 0.0 ? 0.0 : angle};  // below 0 only by rounding
  }

  /// One step of the method, in sub-steps if the drive or an input has a breakpoint inside it:
  /// across a breakpoint a method would lose its order.
  WHIRL_TWIN_INLINE StepStatus advance(Method& method, const Equation& equation, double offset,
                                       double h, MotionState<n>& state) noexcept {
    if constexpr (Form::kMayStick) {
      if (__builtin_expect(Form::sticks(model_), 0)) {
        return advanceSticking(method, equation, offset, h, state);
      }
    }
    if (Step::kWithInputs && __builtin_expect(inputs_.acts(), 0)) {
      return advanceWithInputs(method, equation, offset, h, state);
    }
    if (hasShaft()) {
      const double end = offset + h;
      const double corner = drive_.nextCorner(offset);
      if (corner < end - kSliver * h) {
        return advanceInParts(method, equation, offset, end, state);
      }
      if constexpr (kHasHistory) {
        const StepStatus status = method_step_(method, equation, offset, h, state);
        endAtCorner(method, corner, end, h);
        return status;
      }
    }
    return method_step_(method, equation, offset, h, state);
  }
  [[gnu::noinline, gnu::cold]] StepStatus advanceWithInputs(Method& method,
                                                            const Equation& equation, double offset,
                                                            double h,
                                                            MotionState<n>& state) noexcept {
    const double corner = nextCorner(offset);
    if (corner < offset + h - kSliver * h) {
      return advanceInParts(method, equation, offset, offset + h, state);
    }
    const StepStatus status = partWithInputs(method, equation, offset, h, state);
    endAtCorner(method, corner, offset + h, h);
    return status;
  }
  /// Between breakpoints of the inputs, in sub-steps without start or end of sliding.
  [[gnu::noinline]] StepStatus advanceSticking(Method& method, const Equation& equation,
                                               double offset, double h,
                                               MotionState<n>& state) noexcept {
    const double end = offset + h, sliver = kSliver * h;
    DryFrictionStep<n>& dry = &method == &method_ ? dry_ : finer_dry_;
    Equation acted_on = equation;
    acted_on.inputs = inputs_.acts() ? &inputs_ : nullptr;
    while (end - offset > sliver) {
      const double next = nextCorner(offset), corner = next < end - sliver ? next : end;
      if (corner - offset > sliver) {
        if (inputs_.acts()) {
          dry.restart();
          inputs_.enter(0.5 * (offset + corner));
        }
        const auto advance = [&](const Equation& piece, double from, double length,
                                 MotionState<n>& out, bool past) {
          if (!past) {
            method.restart();
          }
          return inputs_.acts() ? partWithInputs(method, piece, from, length, out)
                                : erasedStep(method, piece, from, length, out);
        };
        const StepStatus status = dry.take(acted_on, offset, corner - offset, state,
                                           typename DryFrictionStep<n>::Advance(advance));
        if (status != StepStatus::kOk) {
          return status;
        }
      }
      offset = corner < end ? std::nextafter(corner, 2.0 * end) : end;
    }
    if (!dry.hasPast()) {
      method.restart();
    }
    return StepStatus::kOk;
  }
  /// The method restarts after a breakpoint, also where the breakpoint is between two steps.
  WHIRL_TWIN_INLINE void endAtCorner([[maybe_unused]] Method& method,
                                     [[maybe_unused]] double corner, [[maybe_unused]] double end,
                                     [[maybe_unused]] double h) noexcept {
    if constexpr (kHasHistory) {
      if (corner <= end + kSliver * h) {
        method.restart();
      }
    }
  }
  StepStatus partWithInputs(Method& method, const Equation& equation, double offset, double h,
                            MotionState<n>& state) noexcept {
    if constexpr (Step::kWithInputs) {
      const MotionState<n> from = state;
      inputs_.enter(offset + 0.5 * h);
      if constexpr (kHasHistory) {
        method.hold(inputs_.held());
      }
      const StepStatus status = Step::calledWith(inputs_, method, equation, offset, h, state);
      double work = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        work += inputs_.held()[i] * ((state.q[i] - from.q[i]) + (state.q_low[i] - from.q_low[i]));
      }
      state.work.add(work);
      return status;
    } else {
      return Step::within(method, equation, offset, h, state);  // none acts
    }
  }
  double nextCorner(double offset) const noexcept {
    double corner = std::numeric_limits<double>::max();
    if (hasShaft()) {
      corner = drive_.nextCorner(offset);
    }
    if (inputs_.acts()) {
      const double of_input = inputs_.nextCorner(offset);
      corner = of_input < corner ? of_input : corner;
    }
    return corner;
  }
  [[gnu::noinline, gnu::cold]] StepStatus advanceInParts(Method& method, const Equation& equation,
                                                         double offset, double end,
                                                         MotionState<n>& state) noexcept {
    const double sliver = kSliver * (end - offset);
    StepStatus status = StepStatus::kOk;
    while (status == StepStatus::kOk && end - offset > sliver) {
      double corner = nextCorner(offset);
      corner = corner < end - sliver ? corner : end;
      if (corner - offset > sliver) {
        method.restart();
        status = inputs_.acts() ? partWithInputs(method, equation, offset, corner - offset, state)
                                : method_step_(method, equation, offset, corner - offset, state);
      }
      // Just after the breakpoint, where the jerk (or acceleration) that follows holds.
      offset = std::nextafter(corner, 2.0 * end);
    }
    method.restart();
    return status;
  }

  /// Repeats `count` steps of h [s] from `start` to state_ as half steps. A multistep method with
  /// full history estimates its error without that.
  [[gnu::noinline]] void estimateError(const Equation& equation, double offset, int count, double h,
                                       const MotionState<n>& start) noexcept {
    const MotionState<n>& end = state_;
    MotionState<n> finer = start;
    const auto add = [&] {
      errors_.add(n, count * h, start.v, end.q, end.v, finer.q, finer.v,
                  [&](std::size_t i) { return Form::angular(model_, i); });
    };
    if constexpr (kHasHistory) {
      if (method_.hasPast()) {
        const std::array<double, n> error = method_.lastError();
        for (std::size_t i = 0; i < n; ++i) {
          finer.q[i] = end.q[i] + count * error[i];
          finer.v[i] = end.v[i] + count / h * error[i];
        }
        add();
        return;
      }
    }
    const double half = 0.5 * h;
    finer_method_.restart();
    finer_dry_.restart();
    for (int i = 0; i < 2 * count; ++i) {
      if (advance(finer_method_, equation, offset + i * half, half, finer) != StepStatus::kOk) {
        errors_.passOver();
        return;
      }
    }
    add();
  }

  static constexpr double kTwoPi = 6.283185307179586;
  static constexpr double kTwoPiLow = 2.4492935982947064e-16;
  static constexpr double kMaxTurned = 1.0e9 * kTwoPi;  ///< in a step, to 1e-6 rad
  static constexpr double kMaxStart = 0x1p53 * kTwoPi;  ///< beyond it no angle has a phase

  Model model_;
  const Drive& drive_;
  double substep_;  ///< [s]
  int substeps_;
  typename Step::Function method_step_ = Step::here();
  Method method_;
  Method finer_method_;
  MotionState<n> state_{};
  StepErrorSum errors_;
  std::int64_t turns_ = 0;  ///< of a spin, beyond its coordinate
  std::conditional_t<Form::kMayStick, DryFrictionStep<n>, NoDryFriction> dry_, finer_dry_;
  InputForce inputs_;  ///< last: few systems have any
};

}  // namespace whirl_twin
