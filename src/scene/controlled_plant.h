// What controllers act on and measure, for small motions: x' = a x + b u, y = c x.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
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

/// [rad/s], at the scene's start, of the shaft of a system; 0 without one.
double startSpeedOf(const Scene& scene, std::size_t system);

/// The matrices of the small motions of a system, by its place in the scene.
using SmallMotions = std::function<Linearization(std::size_t system)>;

/// At the scene's start: about the equilibrium nearest to where a system starts, stable or not, or,
/// where there is none, about where it starts. Its shaft turns at `speed` [rad/s], if that is
/// given, else as at the start.
Linearization smallMotionAtStart(const Scene& scene, std::size_t system,
                                 std::optional<double> speed = std::nullopt);

/// Of the systems that are measured or acted on, in the order of the scene.
LinearPlant linearPlant(const Scene& scene, const std::vector<SignalSpec>& measures,
                        const std::vector<ActedInput>& acts_on, const SmallMotions& small_motions);

}  // namespace whirl_twin
