// Properties of a model required by SteppedSystem: compile-time constants, or the values of a
// ErasedModel.
#pragma once

#include <array>
#include <cstddef>

#include "integration/driven_equation.h"
#include "integration/erased_ode.h"

namespace whirl_twin {

template <class Model>
struct SteppedModel {
  static constexpr std::size_t n = Model::kDof;
  using Array = std::array<double, n>;
  using Equation = DrivenEquation<Model>;

  /// One with dry friction that can hold is stepped by calls (model_entry.h).
  static constexpr bool kMayStick = false;

  static constexpr bool hasShaft(const Model&) { return Model::kHasShaft; }
  static constexpr bool hasSpin(const Model&) { return HasSpin<Model>::value; }
  static constexpr bool angular(const Model&, std::size_t i) { return formOf<Model>().angular[i]; }
  static EquationsOfMotion<double, n> at(const Model& model, const Array& q, const Array& v,
                                         const EvaluationPoint<double>& at) noexcept {
    return equationsAt(model, q, v, at);
  }
  static WHIRL_TWIN_INLINE Equation equation(const Model& model, const Drive& drive, double time) {
    return {model, drive, time};
  }
};

template <std::size_t n>
struct SteppedModel<ErasedModel<n>> {
  using Array = std::array<double, n>;
  using Model = ErasedModel<n>;
  using Equation = ErasedOde<n>;
  static constexpr bool kMayStick = true;

  static bool sticks(const Model& model) { return model.calls().dryContacts().count > 0; }
  static bool hasShaft(const Model& model) { return model.calls().form().has_shaft; }
  static bool hasSpin(const Model& model) { return model.calls().form().has_spin; }
  static bool angular(const Model& model, std::size_t i) { return model.calls().form().angular[i]; }
  static EquationsOfMotion<double, n> at(const Model& model, const Array& q, const Array& v,
                                         const EvaluationPoint<double>& at) noexcept {
    return model.calls().at(q, v, at);
  }
  static Equation equation(const Model& model, const Drive& drive, double time) {
    return {model.calls(), drive, time};
  }
};

}  // namespace whirl_twin
