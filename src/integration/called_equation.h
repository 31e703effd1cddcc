// The equations of a model reached by calls, so that what steps them need not be compiled for each
// model: called_system.h says when.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include "control/drive.h"
#include "integration/acceleration_jacobian.h"
#include "integration/driven_equation.h"
#include "integration/input_force.h"
#include "integration/motion_state.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// A shaft whose angle is the coordinate kSpin, the last.
template <class Model, class = void>
struct HasSpin : std::false_type {};
template <class Model>
struct HasSpin<Model, std::void_t<decltype(Model::kSpin)>> : std::true_type {
  static_assert(Model::kSpin + 1 == Model::kDof);
};

/// What a step has to know of a model besides its equations.
template <std::size_t n>
struct ModelForm {
  bool has_shaft = false;
  bool has_shaft_angle = false;  ///< it enters the equations
  bool has_spin = false;
  std::array<bool, n> angular{};  ///< the coordinate is one of an angle
};

template <class Model>
constexpr ModelForm<Model::kDof> formOf() {
  ModelForm<Model::kDof> form;
  form.has_shaft = Model::kHasShaft;
  form.has_shaft_angle = HasShaftAngle<Model>::value;
  form.has_spin = HasSpin<Model>::value;
  for (std::size_t i = 0; i < Model::kDof; ++i) {
    form.angular[i] = Model::kCoordinates[i].unit[0] == 'r';
  }
  return form;
}

/// The equations of some model of n coordinates.
template <std::size_t n>
class AnyModel {
 public:
  using Array = std::array<double, n>;

  virtual ~AnyModel() = default;
  AnyModel(const AnyModel&) = delete;
  AnyModel& operator=(const AnyModel&) = delete;
  const ModelForm<n>& form() const noexcept { return form_; }
  virtual EquationsOfMotion<double, n> at(const Array& q, const Array& v,
                                          const Moment<double>& at) const noexcept = 0;
  virtual AccelerationJacobian<n> jacobian(const Array& q, const Array& v,
                                           const Array& acceleration,
                                           const Moment<double>& at) const noexcept = 0;

 protected:
  explicit AnyModel(const ModelForm<n>& form) : form_(form) {}

 private:
  const ModelForm<n>& form_;
};

/// Those of a model that outlives this.
template <class Model>
class ModelByCalls : public AnyModel<Model::kDof> {
 public:
  static constexpr std::size_t n = Model::kDof;
  using Array = std::array<double, n>;

  explicit ModelByCalls(const Model& model) : AnyModel<n>(kForm), model_(model) {}
  EquationsOfMotion<double, n> at(const Array& q, const Array& v,
                                  const Moment<double>& at) const noexcept final {
    return equationsAt(model_, q, v, at);
  }
  AccelerationJacobian<n> jacobian(const Array& q, const Array& v, const Array& acceleration,
                                   const Moment<double>& at) const noexcept final {
    return accelerationJacobian(linearization(model_, q, v, acceleration, at));
  }

 private:
  static constexpr ModelForm<n> kForm = formOf<Model>();

  const Model& model_;
};

/// A model that is known by its calls only: what SteppedSystem steps in place of one.
template <std::size_t n>
class CalledModel {
 public:
  static constexpr std::size_t kDof = n;

  template <class Model>
  static CalledModel of(const Model& model) {
    struct Owned : private Owner<Model>, public ModelByCalls<Model> {
      explicit Owned(const Model& of) : Owner<Model>{of}, ModelByCalls<Model>(this->model) {}
    };
    return CalledModel(std::make_shared<const Owned>(model));
  }
  const AnyModel<n>& calls() const noexcept { return *calls_; }

 private:
  template <class Model>
  struct Owner {
    Model model;
  };
  explicit CalledModel(std::shared_ptr<const AnyModel<n>> calls) : calls_(std::move(calls)) {}

  std::shared_ptr<const AnyModel<n>> calls_;
};

/// At an offset [s] of a step that starts at a simulated time [s]; `angle`: with the shaft's.
Moment<double> momentOf(const Drive& drive, bool angle, double time, double offset) noexcept;

/// q'' = a(q, v, t), under inputs in the piece of them that was entered. The power is without that
/// of held inputs, whose work is Q . dq.
template <std::size_t n>
struct CalledEquation {
  using Array = std::array<double, n>;

  const AnyModel<n>& model;
  const Drive& drive;
  double time;                         ///< [s], simulated, at the start of the step
  const InputForce* inputs = nullptr;  ///< nullptr: nothing acts

  Moment<double> moment(double offset) const noexcept {
    if (!model.form().has_shaft) {
      return {time + offset, 0.0, 0.0, 0.0};
    }
    return momentOf(drive, model.form().has_shaft_angle, time, offset);
  }
  /// Without the inputs.
  Derivative<n> evaluate(const Array& q, const Array& v, const Moment<double>& at) const noexcept {
    const EquationsOfMotion<double, n> eom = model.at(q, v, at);
    return {solveMass<double, n>(eom.mass, eom.force), eom.power};
  }
  Derivative<n> operator()(const Array& q, const Array& v, double offset) const noexcept {
    EquationsOfMotion<double, n> eom = model.at(q, v, moment(offset));
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
    return model.jacobian(q, v, (*this)(q, v, offset).acceleration, moment(offset));
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
  const ModelByCalls<Model> calls(equation.model);
  return f(CalledEquation<Model::kDof>{calls, equation.drive, equation.time});
}
template <std::size_t n, class F>
auto withCalls(const CalledEquation<n>& equation, const F& f) {
  return f(equation);
}

}  // namespace whirl_twin
