// The equation that a step integrates: a model and the motion of its shaft. Inputs: erased_step.h.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "control/drive.h"
#include "integration/stage_solver.h"
#include "mechanics/lagrangian.h"
#include "mechanics/lagrangian_dynamics.h"

namespace whirl_twin {

/// Whether the energies and forces depend on the shaft angle; a model can override this.
template <class Model, class = void>
struct HasShaftAngle : std::bool_constant<Model::kHasShaft> {};
template <class Model>
struct HasShaftAngle<Model, std::void_t<decltype(Model::kHasShaftAngle)>>
    : std::bool_constant<Model::kHasShaftAngle> {};

/// q'' = a(q, v, t) of a model on its drive during one step; offset [s] counts from its start.
template <class Model>
struct DrivenEquation {
  static constexpr std::size_t n = Model::kDof;
  using Array = std::array<double, n>;
  using Jacobian = AccelerationJacobian<n>;

  const Model& model;
  const Drive& drive;
  double time;  ///< [s], simulated, at the start of the step

  WHIRL_TWIN_INLINE EvaluationPoint<double> moment(double offset) const {
    if constexpr (Model::kHasShaft) {
      const ShaftMotion shaft =
          HasShaftAngle<Model>::value ? drive.at(offset) : drive.withoutAngle(offset);
      return {time + offset, shaft.angle, shaft.speed, shaft.acceleration};
    } else {
      return {time + offset, 0.0, 0.0, 0.0};
    }
  }
  WHIRL_TWIN_INLINE Derivative<n> evaluate(const Array& q, const Array& v,
                                           const EvaluationPoint<double>& at) const {
    return derivative(model, q, v, at);
  }
  WHIRL_TWIN_INLINE Derivative<n> operator()(const Array& q, const Array& v, double offset) const {
    return evaluate(q, v, moment(offset));
  }
  Jacobian jacobian(const Array& q, const Array& v, double offset) const {
    const EvaluationPoint<double> at = moment(offset);
    return jacobian(q, v, derivative(model, q, v, at).acceleration, at);
  }
  /// Where the acceleration is that of further forces, too.
  Jacobian jacobian(const Array& q, const Array& v, const Array& acceleration,
                    const EvaluationPoint<double>& at) const {
    return accelerationJacobian(linearization(model, q, v, acceleration, at));
  }
  static constexpr bool hasInputs() { return false; }
  /// Is the forcing that of a shaft at one speed? Loads that alternate by themselves are not.
  bool constantSpeed([[maybe_unused]] double duration) const {
    if constexpr (HasAlternatingLoads<Model>::value) {
      return false;
    } else {
      return !Model::kHasShaft || drive.constantFor(duration);
    }
  }
};

}  // namespace whirl_twin
