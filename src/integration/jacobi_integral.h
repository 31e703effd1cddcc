// The Jacobi integral of a model, for steps that know only its matrices.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "mechanics/lagrangian.h"

namespace whirl_twin {

/// The Jacobi integral h [J] of a model at a state of dof() numbers each. Real-time safe.
using JacobiIntegral =
    std::function<double(const double* q, const double* v, const EvaluationPoint<double>& at)>;

/// h = v . dL/dv - L of a model.
template <class Model>
JacobiIntegral jacobiIntegral(const Model& model) {
  return [model](const double* q, const double* v, const EvaluationPoint<double>& at) {
    std::array<double, Model::kDof> position;
    std::array<double, Model::kDof> rate;
    std::copy_n(q, Model::kDof, position.begin());
    std::copy_n(v, Model::kDof, rate.begin());
    const ByRates<Model::kDof> by_rates(position, rate, at);
    const auto kinetic = model.kinetic(by_rates.q, by_rates.v, by_rates.at);
    double h = model.potential(position, at) - kinetic.value;
    for (std::size_t i = 0; i < Model::kDof; ++i) {
      h += rate[i] * kinetic.slope[i];
    }
    return h;
  };
}

}  // namespace whirl_twin
