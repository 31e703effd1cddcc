// Steps whose equations are reached by calls, the methods compiled once for a number of
// coordinates: of systems with inputs, so that steps without are the same code as if there were
// none; of models whose equations are long beside a call; and on processors without fused
// multiply-add, so that steps need not be compiled twice for each model.
#pragma once

#include <array>
#include <cstddef>

#include "integration/dormand_prince_8.h"
#include "integration/driven_equation.h"
#include "integration/exponential.h"
#include "integration/gauss_legendre.h"
#include "integration/input_force.h"
#include "integration/motion_state.h"
#include "integration/runge_kutta_4.h"
#include "integration/semi_implicit_euler.h"
#include "integration/velocity_verlet.h"

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

// Compiled in called_step.cpp for the numbers of coordinates that the package's own models have.
#define WHIRL_TWIN_CALLED_STEP(storage, Method, n)                                          \
  storage template StepStatus calledStep(Method&, const CalledEquation<n>&, double, double, \
                                         MotionState<n>&) noexcept;
#define WHIRL_TWIN_CALLED_STEPS(storage, n)               \
  WHIRL_TWIN_CALLED_STEP(storage, SemiImplicitEuler, n)   \
  WHIRL_TWIN_CALLED_STEP(storage, VelocityVerlet, n)      \
  WHIRL_TWIN_CALLED_STEP(storage, RungeKutta4, n)         \
  WHIRL_TWIN_CALLED_STEP(storage, DormandPrince8, n)      \
  WHIRL_TWIN_CALLED_STEP(storage, ImplicitMidpoint<n>, n) \
  WHIRL_TWIN_CALLED_STEP(storage, GaussLegendre4<n>, n)   \
  WHIRL_TWIN_CALLED_STEP(storage, GaussLegendre6<n>, n)   \
  WHIRL_TWIN_CALLED_STEP(storage, Exponential<n>, n)
WHIRL_TWIN_CALLED_STEPS(extern, 1)
WHIRL_TWIN_CALLED_STEPS(extern, 2)
WHIRL_TWIN_CALLED_STEPS(extern, 3)
WHIRL_TWIN_CALLED_STEPS(extern, 4)

}  // namespace whirl_twin
