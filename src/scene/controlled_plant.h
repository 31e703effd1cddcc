// What controllers act on and measure, for small motions: x' = a x + b u, y = c x.
#pragma once

#include <vector>

#include "controllers/controller_info.h"
#include "scene/controller_spec.h"
#include "scene/scene.h"

namespace whirl_twin {

/// A measured signal as a row: its value is along . q, or along . v.
struct SignalRow {
  Eigen::VectorXd along;
  bool of_rates = false;
};
SignalRow rowOf(const SignalSpec& signal, const Dynamics& dynamics);

/// Of the systems that are measured or acted on, in the order of the scene, at its start: at the
/// speeds of their drives, about the equilibrium nearest to where they start, stable or not, or,
/// where there is none, about where they start.
LinearPlant linearPlant(const Scene& scene, const std::vector<SignalSpec>& measures,
                        const std::vector<ActedInput>& acts_on);

}  // namespace whirl_twin
