// Linear plant of controllers, from the inputs acted on to the signals measured: x' = a x + b u, y
// = c x.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "controllers/controller_info.h"
#include "scene/closed_loop_equilibrium.h"
#include "scene/controller_spec.h"
#include "scene/scene.h"

namespace whirl_twin {

/// A measured signal as a row vector: its value is along . q, or along . v.
struct SignalRow {
  Eigen::VectorXd along;
  bool of_rates = false;
};
SignalRow rowOf(const SignalSpec& signal, const Dynamics& dynamics);

/// [rad/s], initial shaft speed of a system; 0 without a shaft.
double startSpeedOf(const Scene& scene, std::size_t system);

/// Initial motion of a system, at the shaft speed `speed` [rad/s], by default the initial one.
SystemMotion motionAtStart(const Scene& scene, std::size_t system,
                           std::optional<double> speed = std::nullopt);

/// Without inputs: the equilibrium nearest to a motion, stable or not; if there is none, the
/// present coordinates with zero rates.
ClosedLoopEquilibrium restNear(const SystemMotion& present);

/// Linearized about these motions of the systems that are measured or acted on; in their order.
LinearPlant linearPlant(const std::vector<SignalSpec>& measures,
                        const std::vector<ActedInput>& acts_on, const HeldMotions& about);

}  // namespace whirl_twin
