// What `twin loop` shows: stability and margins of the sampled control loops of a scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/sampled_margins.h"
#include "analysis/sampled_stability.h"
#include "controllers/controller.h"
#include "reports/figure.h"
#include "reports/output.h"
#include "scene/scene.h"

namespace whirl_twin {

/// A controller in its loop.
struct LoopedController {
  const ControllerSpec* spec = nullptr;
  std::vector<std::string> loop;  ///< all controllers of its loop, itself among them
  double shaft_speed = 0.0;       ///< [rad/s], of the linearization
  /// Inputs and outputs at the closed-loop equilibrium, about which it is linearized. Empty: there
  /// is none, and it is linearized about the equilibria nearest to the start.
  std::vector<double> held_measured, held_outputs;
  /// From what it measures to its outputs, at the shaft speed; nothing where it is not linear.
  std::optional<DiscreteStateSpace> law;
  std::vector<Controller::Gain> gains;
  /// Nothing where a control law of the loop is not linear.
  std::optional<SampledStability> stability;
  double period = 0.0;  ///< [s], that the spectral radius is of: of a sample, or, of several
                        ///< rates, after which they come again
  LoopMargins at_once;  ///< of all sensors of its loop, or all outputs, changed alike
  std::vector<SampledMargins> margins;     ///< at each of its sensors alone, all other loops closed
  std::vector<SampledMargins> at_outputs;  ///< likewise at each output, the input of the plant
  /// Loops opened at each of them, for pictures.
  std::vector<LoopResponse> responses;
  std::string objection;  ///< why the loop cannot be evaluated; else ""
};

struct LoopReport {
  const Scene* scene = nullptr;
  std::vector<LoopedController> controllers;  ///< in the order of the scene
};

/// About the motions that the loops hold their systems in (scene/closed_loop_equilibrium.h), found
/// from where these start, at their shafts' speeds there or at `speed` [rad/s].
LoopReport loopReport(const Scene& scene, std::optional<double> speed = std::nullopt);

Json json(const LoopReport& report);
std::string text(const LoopReport& report);
/// Bode and Nyquist diagrams of the loop opened at each of its sensors, and the sensitivity there
/// over the zones of ISO 14839-3. Of a controller whose loop was evaluated.
Figure figure(const LoopedController& controller);

}  // namespace whirl_twin
