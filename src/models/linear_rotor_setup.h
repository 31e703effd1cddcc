// The setup of a model whose dynamics are a linear rotor, or that steps as one in a run-up.
#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "integration/linear_rotor_stepper.h"
#include "mechanics/dynamics.h"
#include "mechanics/gradient.h"
#include "models/model_info.h"

namespace whirl_twin {

/// The setup of a model whose dynamics are a linear rotor: it steps with `exponential`, at constant
/// and at changing speed.
ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics);

/// A setup of a linear model with a shaft, in the fixed frame, whose `exponential` follows a
/// changing speed by that step where its matrices change with speed; else as it was.
ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi);

/// h = v . dL/dv - L of a model.
template <class Model>
JacobiIntegral jacobiIntegral(const Model& model) {
  return [model](const double* q, const double* v, const Moment<double>& at) {
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
