// Model x method, composed at compile time. Compiled only in the translation units of models/, with
// the flags that let the compiler delete a dual's dead terms; the finiteness check reads bits.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>

#include "control/drive.h"
#include "control/shaft_angle.h"
#include "integration/called_step.h"
#include "integration/driven_equation.h"
#include "integration/finite.h"
#include "integration/input_force.h"
#include "integration/step_error_sum.h"
#include "integration/stepped_ahead.h"
#include "integration/stepper.h"
#include "mechanics/dynamics.h"

#if defined(__x86_64__) && !defined(__clang__)
#define WHIRL_TWIN_FUSED_STEPS
#endif

namespace whirl_twin {

#ifdef WHIRL_TWIN_LONG_EQUATIONS
constexpr bool kLongEquations = true;
#else
constexpr bool kLongEquations = false;
#endif

/// A shaft whose angle is the coordinate kSpin.
template <class Model, class = void>
struct HasSpin : std::false_type {};
template <class Model>
struct HasSpin<Model, std::void_t<decltype(Model::kSpin)>> : std::true_type {};

/// A method whose steps rest on those before: its past is dropped where the motion is not smooth.
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
    return take(time, static_cast<double>(from) / 1e9, static_cast<int>(count), length / count);
  }
  double errorSum() const noexcept override { return errors_.sum(); }
  std::size_t dof() const noexcept override { return n; }
  void motion(double* out) const noexcept override {
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = state_.q[i];
      out[n + i] = state_.v[i];
    }
    if constexpr (HasSpin<Model>::value) {
      out[Model::kSpin] = spin().total();
    }
  }
  void write(double* out) const noexcept override {
    motion(out);
    out[2 * n] = state_.work.high;
  }
  /// Of a method with a past, where no spin is a coordinate.
  void readOff([[maybe_unused]] const StoermerReading& reading, [[maybe_unused]] bool with_work,
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
  bool shaft([[maybe_unused]] ShaftState& out) const noexcept override {
    if constexpr (HasSpin<Model>::value) {
      // No load on a rotor depends on the time by itself.
      auto eom = equationsOfMotion(model_, state_.q, state_.v, Moment<double>{});
      if (inputs_.acts()) {
        std::array<double, n> applied;
        inputs_.now(applied.data());
        for (std::size_t i = 0; i < n; ++i) {
          eom.force[i] += applied[i];
        }
      }
      out = {spin(), state_.v[Model::kSpin],
             solveMass<double, n>(eom.mass, eom.force)[Model::kSpin]};
    }
    return HasSpin<Model>::value;
  }
  void set(const double* q, const double* v) noexcept override {
    state_ = MotionState<n>{};
    for (std::size_t i = 0; i < n; ++i) {
      state_.q[i] = q[i];
      state_.v[i] = v[i];
    }
    turns_ = 0;
    if constexpr (HasSpin<Model>::value) {
      if (isFinite(q[Model::kSpin]) && std::fabs(q[Model::kSpin]) < kLargestStart) {
        const ShaftAngle angle = shaftAngle(q[Model::kSpin]);
        turns_ = angle.turns;
        state_.q[Model::kSpin] = angle.remainder;
      }
    }
    method_.restart();
    errors_.restart();
  }
  void exchange(StateImage& image) noexcept override {
    image(method_, finer_method_, state_, errors_, turns_);
  }

 private:
  static constexpr bool kHasHistory = HasHistory<Method>::value;

  /// `count` steps of the method of h [s] each, from an offset [s] after `time` [s] on.
  WHIRL_TWIN_INLINE StepStatus take(double time, double offset, int count, double h) noexcept {
    const DrivenEquation<Model> equation{model_, drive_, time};
    if constexpr (kHasHistory && Model::kHasShaft) {
      const ShaftMotion shaft = drive_.withoutAngle(0.0);  // a command may have changed its course
      method_.follow(shaft.jerk, shaft.acceleration);
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
  /// The state is again what it was: the past that the method has is another's.
  [[gnu::noinline, gnu::cold]] StepStatus goBack(const MotionState<n>& start,
                                                 StepStatus why) noexcept {
    state_ = start;
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

  /// A spin that went further in one step has no phase left in a double.
  static WHIRL_TWIN_INLINE bool hasPhase([[maybe_unused]] const MotionState<n>& state) noexcept {
    if constexpr (HasSpin<Model>::value) {
      return std::fabs(state.q[Model::kSpin]) < kMostTurned;
    }
    return true;
  }

  /// The spin is stepped as whole turns and a remainder, so that its phase is as exact after a
  /// month as after a second; 2 pi is taken off with 106 bits.
  WHIRL_TWIN_INLINE void wholeTurns() noexcept {
    if constexpr (HasSpin<Model>::value) {
      double& angle = state_.q[Model::kSpin];
      if (angle >= 0.0 && angle < kTwoPi) {
        return;
      }
      const double turns = std::floor(angle / kTwoPi);
      const double whole = turns * kTwoPi;
      const double error = std::fma(turns, kTwoPi, -whole) + turns * kTwoPiLow;
      CompensatedSum rest{angle - whole, state_.q_low[Model::kSpin]};
      rest.add(-error);
      angle = rest.high;
      state_.q_low[Model::kSpin] = rest.low;
      turns_ += static_cast<std::int64_t>(turns);
    }
  }
  ShaftAngle spin() const noexcept {
    const double angle = state_.q[n - 1];        // the spin is the last
    return {turns_, angle < 0.0 ? 0.0 : angle};  // below 0 only by rounding
  }

  // Three ways to take a step of the method; one or two of them are compiled.

  /// The equations within the method, in one copy for a system and a method.
  [[gnu::noinline]] static StepStatus methodStep(Method& method,
                                                 const DrivenEquation<Model>& equation,
                                                 double offset, double h,
                                                 MotionState<n>& state) noexcept {
    return method.step(equation, offset, h, state);
  }
#ifdef WHIRL_TWIN_FUSED_STEPS
  /// The same with fused multiply-add, which takes half as long for sums of products.
  [[gnu::noinline, gnu::target("avx2,fma")]] static StepStatus fusedMethodStep(
      Method& method, const DrivenEquation<Model>& equation, double offset, double h,
      MotionState<n>& state) noexcept {
    return method.step(equation, offset, h, state);
  }
#endif
  /// The equations reached by calls.
  static StepStatus calledMethodStep(Method& method, const DrivenEquation<Model>& equation,
                                     double offset, double h, MotionState<n>& state) noexcept {
    const EquationOf<Model> own(equation);
    return calledStep(method, CalledEquation<n>{own}, offset, h, state);
  }

  using MethodStep = StepStatus (*)(Method&, const DrivenEquation<Model>&, double, double,
                                    MotionState<n>&) noexcept;
  /// The one for the processor this runs on; linear models have the exact steps if they must be
  /// fast.
  static MethodStep methodStepHere() {
    if constexpr (kLongEquations && !Model::kLinear) {
      return calledMethodStep;
    } else {
#ifdef WHIRL_TWIN_FUSED_STEPS
      if constexpr (!Model::kLinear) {
        return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0
                   ? fusedMethodStep
                   : calledMethodStep;
      }
#endif
      return methodStep;
    }
  }

  /// One step of the method, in parts where the drive or an input has a corner inside it: across a
  /// corner a method would lose its order.
  WHIRL_TWIN_INLINE StepStatus advance(Method& method, const DrivenEquation<Model>& equation,
                                       double offset, double h, MotionState<n>& state) noexcept {
    if (__builtin_expect(inputs_.acts(), 0)) {
      return advanceWithInputs(method, equation, offset, h, state);
    }
    if constexpr (Model::kHasShaft) {
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
                                                            const DrivenEquation<Model>& equation,
                                                            double offset, double h,
                                                            MotionState<n>& state) noexcept {
    const double corner = nextCorner(offset);
    if (corner < offset + h - kSliver * h) {
      return advanceInParts(method, equation, offset, offset + h, state);
    }
    const StepStatus status = partWithInputs(method, equation, offset, h, state);
    endAtCorner(method, corner, offset + h, h);
    return status;
  }
  /// Beyond a corner a step begins anew, also where the corner is between two steps.
  WHIRL_TWIN_INLINE void endAtCorner([[maybe_unused]] Method& method,
                                     [[maybe_unused]] double corner, [[maybe_unused]] double end,
                                     [[maybe_unused]] double h) noexcept {
    if constexpr (kHasHistory) {
      if (corner <= end + kSliver * h) {
        method.restart();
      }
    }
  }
  StepStatus partWithInputs(Method& method, const DrivenEquation<Model>& equation, double offset,
                            double h, MotionState<n>& state) noexcept {
    const MotionState<n> from = state;
    inputs_.enter(offset + 0.5 * h);
    if constexpr (kHasHistory) {
      method.hold(inputs_.held());
    }
    const EquationOf<Model> own(equation);
    const StepStatus status =
        calledStep(method, CalledEquation<n>{own, &inputs_}, offset, h, state);
    double work = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      work += inputs_.held()[i] * ((state.q[i] - from.q[i]) + (state.q_low[i] - from.q_low[i]));
    }
    state.work.add(work);
    return status;
  }
  double nextCorner(double offset) const noexcept {
    double corner = std::numeric_limits<double>::max();
    if constexpr (Model::kHasShaft) {
      corner = drive_.nextCorner(offset);
    }
    if (inputs_.acts()) {
      const double of_input = inputs_.nextCorner(offset);
      corner = of_input < corner ? of_input : corner;
    }
    return corner;
  }
  [[gnu::noinline, gnu::cold]] StepStatus advanceInParts(Method& method,
                                                         const DrivenEquation<Model>& equation,
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
      // Just behind the corner, where the jerk (or acceleration) that follows holds.
      offset = std::nextafter(corner, 2.0 * end);
    }
    method.restart();
    return status;
  }

  /// Takes `count` steps of h [s] from `start` to state_ once more, in halves. A method with a past
  /// knows its error without, once it has one.
  [[gnu::noinline]] void estimateError(const DrivenEquation<Model>& equation, double offset,
                                       int count, double h, const MotionState<n>& start) noexcept {
    const MotionState<n>& end = state_;
    MotionState<n> finer = start;
    const auto add = [&] {
      errors_.add(n, end.q, end.v, finer.q, finer.v,
                  [](std::size_t i) { return Model::kCoordinates[i].unit[0] == 'r'; });
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
    for (int i = 0; i < 2 * count; ++i) {
      if (advance(finer_method_, equation, offset + i * half, half, finer) != StepStatus::kOk) {
        errors_.passOver();
        return;
      }
    }
    add();
  }

  /// Parts shorter than this share of a substep are not worth a step: they are rounding.
  static constexpr double kSliver = 1.0e-12;
  static constexpr double kTwoPi = 6.283185307179586;
  static constexpr double kTwoPiLow = 2.4492935982947064e-16;
  static constexpr double kMostTurned = 1.0e9 * kTwoPi;     ///< in a step, to 1e-6 rad
  static constexpr double kLargestStart = 0x1p53 * kTwoPi;  ///< beyond it no angle has a phase

  Model model_;
  const Drive& drive_;
  double substep_;  ///< [s]
  int substeps_;
  MethodStep method_step_ = methodStepHere();
  Method method_;
  Method finer_method_;
  MotionState<n> state_{};
  StepErrorSum errors_;
  std::int64_t turns_ = 0;  ///< of a spin, beyond its coordinate
  InputForce inputs_;       ///< last: few systems have any
};

}  // namespace whirl_twin
