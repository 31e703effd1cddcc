// What controllers act on and measure, for small motions: x' = a x + b u, y = c x.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "controllers/controller_info.h"
#include "scene/controller_spec.h"
#include "scene/held_motion.h"
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

/// Where a system starts. Its shaft turns at `speed` [rad/s], if that is given, else as at the
/// start.
SystemMotion motionAtStart(const Scene& scene, std::size_t system,
                           std::optional<double> speed = std::nullopt);

/// Without inputs: the equilibrium nearest to a motion, stable or not, or, where there is none, its
/// place, at rest.
HeldMotion restNear(const SystemMotion& present);

/// About these motions of the systems that are measured or acted on; in their order.
LinearPlant linearPlant(const std::vector<SignalSpec>& measures,
                        const std::vector<ActedInput>& acts_on, const HeldMotions& about);

}  // namespace whirl_twin
