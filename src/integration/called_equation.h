// The equations of a model reached by calls, so that what steps them need not be compiled for each
// model: called_step.h says when.
#pragma once

#include <array>
#include <cstddef>

#include "integration/driven_equation.h"
#include "integration/input_force.h"
#include "integration/motion_state.h"

namespace whirl_twin {

/// The equations of some model of n coordinates, on its drive, during one step.
template <std::size_t n>
class AnyEquation {
 public:
  using Array = std::array<double, n>;

  AnyEquation(const AnyEquation&) = delete;
  AnyEquation& operator=(const AnyEquation&) = delete;
  virtual Moment<double> moment(double offset) const noexcept = 0;
  virtual EquationsOfMotion<double, n> at(const Array& q, const Array& v,
                                          const Moment<double>& at) const noexcept = 0;
  virtual AccelerationJacobian<n> jacobian(const Array& q, const Array& v,
                                           const Array& acceleration,
                                           const Moment<double>& at) const noexcept = 0;

 protected:
  AnyEquation() = default;
  ~AnyEquation() = default;
};

template <class Model>
class EquationOf final : public AnyEquation<Model::kDof> {
 public:
  static constexpr std::size_t n = Model::kDof;
  using Array = std::array<double, n>;

  explicit EquationOf(const DrivenEquation<Model>& equation) : equation_(equation) {}
  Moment<double> moment(double offset) const noexcept override { return equation_.moment(offset); }
  EquationsOfMotion<double, n> at(const Array& q, const Array& v,
                                  const Moment<double>& at) const noexcept override {
    return equationsOfMotion(equation_.model, q, v, at);
  }
  AccelerationJacobian<n> jacobian(const Array& q, const Array& v, const Array& acceleration,
                                   const Moment<double>& at) const noexcept override {
    return equation_.jacobian(q, v, acceleration, at);
  }

 private:
  const DrivenEquation<Model>& equation_;
};

/// q'' = a(q, v, t), under inputs in the piece of them that was entered. The power is without that
/// of held inputs, whose work is Q . dq.
template <std::size_t n>
struct CalledEquation {
  using Array = std::array<double, n>;

  const AnyEquation<n>& own;
  const InputForce* inputs = nullptr;  ///< nullptr: nothing acts

  Moment<double> moment(double offset) const noexcept { return own.moment(offset); }
  /// Without the inputs.
  Derivative<n> evaluate(const Array& q, const Array& v, const Moment<double>& at) const noexcept {
    const EquationsOfMotion<double, n> eom = own.at(q, v, at);
    return {solveMass<double, n>(eom.mass, eom.force), eom.power};
  }
  Derivative<n> operator()(const Array& q, const Array& v, double offset) const noexcept {
    EquationsOfMotion<double, n> eom = own.at(q, v, moment(offset));
    if (hasInputs()) {
      Array all;
      Array varying;
      inputs->at(offset, all.data(), varying.data());
      for (std::size_t j = 0; j < n; ++j) {
        eom.force[j] += all[j];
        eom.power += v[j] * varying[j];
      }
    }
    return {solveMass<double, n>(eom.mass, eom.force), eom.power};
  }
  AccelerationJacobian<n> jacobian(const Array& q, const Array& v, double offset) const noexcept {
    return own.jacobian(q, v, (*this)(q, v, offset).acceleration, moment(offset));
  }
  bool hasInputs() const { return inputs != nullptr; }
  /// Of no use but to the exact step, which is reached by calls only with inputs.
  static constexpr bool constantSpeed(double /*duration*/) { return false; }
};

/// Of `h` [s] from `offset` [s] on.
template <class Method, std::size_t n>
[[gnu::noinline]] StepStatus calledStep(Method& method, const CalledEquation<n>& equation,
                                        double offset, double h, MotionState<n>& state) noexcept {
  return method.step(equation, offset, h, state);
}

/// f(equation), the equation by calls.
template <class Model, class F>
auto withCalls(const DrivenEquation<Model>& equation, const F& f) {
  const EquationOf<Model> own(equation);
  return f(CalledEquation<Model::kDof>{own});
}
template <std::size_t n, class F>
auto withCalls(const CalledEquation<n>& equation, const F& f) {
  return f(equation);
}

}  // namespace whirl_twin
