// Ways to take one step of a method: of them one or two are compiled for a model.
#pragma once

#include <cstddef>
#include <type_traits>

#include "integration/erased_step.h"
#include "integration/exponential.h"
#include "integration/stepped_model.h"

#if defined(__x86_64__) && !defined(__clang__)
#define WHIRL_TWIN_FUSED_STEPS
#endif

namespace whirl_twin {

template <class Model, class Method>
struct MethodStep {
  static constexpr std::size_t n = Model::kDof;
  using Equation = typename SteppedModel<Model>::Equation;
  using Function = StepStatus (*)(Method&, const Equation&, double, double,
                                  MotionState<n>&) noexcept;

  /// The equations within the method, in one copy for a system and a method.
  [[gnu::noinline]] static StepStatus within(Method& method, const Equation& equation,
                                             double offset, double h,
                                             MotionState<n>& state) noexcept {
    return method.step(equation, offset, h, state);
  }
#ifdef WHIRL_TWIN_FUSED_STEPS
  /// The same with fused multiply-add, which takes half as long for sums of products.
  [[gnu::noinline, gnu::target("avx2,fma")]] static StepStatus fused(
      Method& method, const Equation& equation, double offset, double h,
      MotionState<n>& state) noexcept {
    return method.step(equation, offset, h, state);
  }
#endif
  /// The equations reached by calls.
  static StepStatus called(Method& method, const Equation& equation, double offset, double h,
                           MotionState<n>& state) noexcept {
    return withCalls(equation, [&](const ErasedOde<n>& by_calls) {
      return erasedStep(method, by_calls, offset, h, state);
    });
  }
  /// The exact step under inputs is another engine's (models/exact_stepper.h), but of loads that
  /// alternate by themselves.
  static constexpr bool kWithInputs =
      !std::is_same_v<Method, Exponential<n>> || HasAlternatingLoads<Model>::value;
  /// The same, under inputs.
  static StepStatus calledWith(const InputForce& inputs, Method& method, const Equation& equation,
                               double offset, double h, MotionState<n>& state) noexcept {
    return withCalls(equation, [&](ErasedOde<n> by_calls) {
      by_calls.inputs = &inputs;
      return erasedStep(method, by_calls, offset, h, state);
    });
  }

  /// The one for the processor this runs on; linear models have the exact steps if they must be
  /// fast.
  static Function here() {
    return choice(static_cast<const Model*>(nullptr));
  }

 private:
  template <std::size_t count>
  static Function choice(const ErasedModel<count>*) {
    return called;
  }
  template <class Composed>
  static Function choice(const Composed*) {
#ifdef WHIRL_TWIN_FUSED_STEPS
    if constexpr (!Composed::kLinear) {
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 ? fused
                                                                                       : called;
    }
#endif
    return within;
  }
};

}  // namespace whirl_twin
