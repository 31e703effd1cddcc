// Type-erased equations of a model, so that the stepper need not be compiled for each model (see
// erased_system.h).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include "control/drive.h"
#include "integration/driven_equation.h"
#include "integration/input_force.h"
#include "integration/motion_state.h"
#include "integration/stage_solver.h"
#include "mechanics/dry_friction.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// A shaft whose angle is the coordinate kSpin, the last.
template <class Model, class = void>
struct HasSpin : std::false_type {};
template <class Model>
struct HasSpin<Model, std::void_t<decltype(Model::kSpin)>> : std::true_type {
  static_assert(Model::kSpin + 1 == Model::kDof);
};

/// Properties of a model that a step needs besides its equations.
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
                                          const EvaluationPoint<double>& at) const noexcept = 0;
  virtual AccelerationJacobian<n> jacobian(const Array& q, const Array& v,
                                           const Array& acceleration,
                                           const EvaluationPoint<double>& at) const noexcept = 0;
  /// Dry friction (mechanics/dry_friction.h): where, and the force of the contacts' shares.
  virtual const DryContacts<n>& dryContacts() const noexcept = 0;
  virtual Array dryFriction(const Array& q, const ContactNumbers& share) const noexcept = 0;

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

  explicit ModelByCalls(const Model& model)
      : AnyModel<n>(kForm), model_(model), contacts_(HasDryContacts<Model>::of(model)) {}
  EquationsOfMotion<double, n> at(const Array& q, const Array& v,
                                  const EvaluationPoint<double>& at) const noexcept final {
    return equationsAt(model_, q, v, at);
  }
  AccelerationJacobian<n> jacobian(const Array& q, const Array& v, const Array& acceleration,
                                   const EvaluationPoint<double>& at) const noexcept final {
    return accelerationJacobian(linearization(model_, q, v, acceleration, at));
  }
  const DryContacts<n>& dryContacts() const noexcept final { return contacts_; }
  Array dryFriction(const Array& q, const ContactNumbers& share) const noexcept final {
    return whirl_twin::dryFriction(model_, contacts_, q, share);
  }

 private:
  static constexpr ModelForm<n> kForm = formOf<Model>();

  const Model& model_;
  DryContacts<n> contacts_;
};

/// A type-erased model for SteppedSystem.
template <std::size_t n>
class ErasedModel {
 public:
  static constexpr std::size_t kDof = n;

  template <class Model>
  static ErasedModel of(const Model& model) {
    struct Owned : private Owner<Model>, public ModelByCalls<Model> {
      explicit Owned(const Model& of) : Owner<Model>{of}, ModelByCalls<Model>(this->model) {}
    };
    return ErasedModel(std::make_shared<const Owned>(model));
  }
  const AnyModel<n>& calls() const noexcept { return *calls_; }

 private:
  template <class Model>
  struct Owner {
    Model model;
  };
  explicit ErasedModel(std::shared_ptr<const AnyModel<n>> calls) : calls_(std::move(calls)) {}

  std::shared_ptr<const AnyModel<n>> calls_;
};

/// At an offset [s] of a step that starts at a simulated time [s]; `angle`: with the shaft's.
EvaluationPoint<double> momentOf(const Drive& drive, bool angle, double time,
                                 double offset) noexcept;

/// q'' = a(q, v, t), under inputs in the piece of them that was entered. The power is without that
/// of held inputs, whose work is Q . dq. Dry friction acts as in the state given, however the rates
/// of a trial may be, so that the equations of a step are smooth.
template <std::size_t n>
struct ErasedOde {
  using Array = std::array<double, n>;

  const AnyModel<n>& model;
  const Drive& drive;
  double time;                         ///< [s], simulated, at the start of the step
  const InputForce* inputs = nullptr;  ///< nullptr: nothing acts
  const DryState<n>* dry = nullptr;    ///< nullptr: no contact, or given by the rates

  EvaluationPoint<double> moment(double offset) const noexcept {
    if (!model.form().has_shaft) {
      return {time + offset, 0.0, 0.0, 0.0};
    }
    return momentOf(drive, model.form().has_shaft_angle, time, offset);
  }
  /// Without the inputs.
  Derivative<n> evaluate(const Array& q, const Array& v,
                         const EvaluationPoint<double>& at) const noexcept {
    const EquationsOfMotion<double, n> eom = model.at(q, v, at);
    return {solveMass<double, n>(eom.mass, eom.force), eom.power};
  }
  Derivative<n> operator()(const Array& q, const Array& v, double offset) const noexcept {
    EquationsOfMotion<double, n> eom = equations(q, v, offset);
    if (dry != nullptr) {
      DryState<n> state = *dry;
      return withFriction(q, v, eom, state);
    }
    return {solveMass<double, n>(eom.mass, eom.force), eom.power};
  }
  AccelerationJacobian<n> jacobian(const Array& q, const Array& v, double offset) const noexcept {
    AccelerationJacobian<n> j =
        model.jacobian(q, v, (*this)(q, v, offset).acceleration, moment(offset));
    if (dry != nullptr && dry->holdsAny()) {
      hold(q, v, offset, j);
    }
    return j;
  }
  /// The states of the contacts, from the rates and, for those that do not slide, from the friction
  /// needed for sticking.
  [[gnu::noinline]] DryState<n> dryStateAt(const Array& q, const Array& v,
                                           double offset) const noexcept {
    const DryContacts<n>& contacts = model.dryContacts();
    DryState<n> sliding;
    sliding.share = contacts.slidingShares(v);
    if (sliding.share[0] != 0.0 && (contacts.count < 2 || sliding.share[1] != 0.0)) {
      return sliding;
    }
    EquationsOfMotion<double, n> eom = equations(q, v, offset);
    withoutFriction(q, v, eom);
    return dryState(eom.mass, eom.force, model.dryContacts(), v,
                    [&](const ContactNumbers& share) { return model.dryFriction(q, share); });
  }
  /// The shares of friction that keep the sticking contacts sticking.
  [[gnu::noinline]] ContactNumbers sharesAt(const Array& q, const Array& v,
                                            double offset) const noexcept {
    EquationsOfMotion<double, n> eom = equations(q, v, offset);
    DryState<n> state = *dry;
    withFriction(q, v, eom, state);
    return state.share;
  }
  bool hasInputs() const { return inputs != nullptr; }
  /// For the exact step only, which is type-erased only with inputs.
  static constexpr bool constantSpeed(double /*duration*/) { return false; }

 private:
  EquationsOfMotion<double, n> equations(const Array& q, const Array& v,
                                         double offset) const noexcept {
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
    return eom;
  }
  /// Removes the dry friction given by the rates.
  void withoutFriction(const Array& q, const Array& v,
                       EquationsOfMotion<double, n>& eom) const noexcept {
    const Array said = model.dryFriction(q, model.dryContacts().computedShares(v));
    for (std::size_t i = 0; i < n; ++i) {
      eom.force[i] -= said[i];
      eom.power -= v[i] * said[i];
    }
  }
  [[gnu::noinline]] Derivative<n> withFriction(const Array& q, const Array& v,
                                               EquationsOfMotion<double, n>& eom,
                                               DryState<n>& state) const noexcept {
    withoutFriction(q, v, eom);
    const auto friction = [&](const ContactNumbers& share) { return model.dryFriction(q, share); };
    const Array a =
        accelerationWithFriction(eom.mass, eom.force, model.dryContacts(), friction, state);
    const Array acting = friction(state.share);
    for (std::size_t i = 0; i < n; ++i) {
      eom.power += v[i] * acting[i];
    }
    return {a, eom.power};
  }
  /// Sticking contacts do not accelerate: of the changes of the accelerations only the orthogonal
  /// part remains.
  [[gnu::noinline]] void hold(const Array& q, const Array& v, double offset,
                              AccelerationJacobian<n>& j) const noexcept {
    const EquationsOfMotion<double, n> eom = model.at(q, v, moment(offset));
    for (std::size_t k = 0; k < kMaxContacts; ++k) {
      if (!dry->held[k]) {
        continue;
      }
      const Array& direction = model.dryContacts().at[k].direction;
      const Array moved = solveMass<double, n>(eom.mass, direction);
      double gives = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        gives += direction[i] * moved[i];
      }
      for (auto* const by : {&j.by_q, &j.by_v}) {
        for (std::size_t column = 0; column < n; ++column) {
          double along = 0.0;
          for (std::size_t i = 0; i < n; ++i) {
            along += direction[i] * (*by)(i, column);
          }
          for (std::size_t i = 0; i < n; ++i) {
            (*by)(i, column) -= moved[i] * along / gives;
          }
        }
      }
    }
  }
};

/// Of `h` [s] from `offset` [s] on.
template <class Method, std::size_t n>
[[gnu::noinline]] StepStatus erasedStep(Method& method, const ErasedOde<n>& equation, double offset,
                                        double h, MotionState<n>& state) noexcept {
  return method.step(equation, offset, h, state);
}

/// f(equation), with the type-erased equation.
template <class Model, class F>
auto withCalls(const DrivenEquation<Model>& equation, const F& f) {
  const ModelByCalls<Model> calls(equation.model);
  return f(ErasedOde<Model::kDof>{calls, equation.drive, equation.time});
}
template <std::size_t n, class F>
auto withCalls(const ErasedOde<n>& equation, const F& f) {
  return f(equation);
}

}  // namespace whirl_twin
