// Controllers coupled by shared systems, and the closed loop that they form.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/sampled_loop.h"
#include "controllers/controller.h"
#include "messages/states.h"
#include "scene/controlled_plant.h"
#include "scene/scene.h"

namespace whirl_twin {

class ClosedLoop {
 public:
  /// For these controllers of a scene, with their initial control laws.
  ClosedLoop(const Scene& scene, std::vector<std::size_t> controllers);

  const std::vector<std::size_t>& controllers() const { return controllers_; }
  std::vector<std::size_t> systems() const;                         ///< ascending
  const Controller& law(std::size_t i) const { return *laws_[i]; }  ///< of the i-th
  const ControllerSpec& controller(std::size_t i) const {           ///< i-th of controllers()
    return scene_.controllers[controllers_[i]];
  }
  const std::string& nameOf(std::size_t system) const { return scene_.systems[system].name; }
  /// The system whose shaft speed the control laws use: the first that the first controller
  /// measures.
  std::size_t leadingSystem() const { return controller(0).measures.front().system; }
  bool has(const std::string& controller) const;
  /// The numbers of one of these controllers.
  state::ParameterChange parametersOf(const std::string& controller) const;

  /// The loop with the complete set of numbers that a twin has published for one of its
  /// controllers; nothing if it has no controller of that name, or the set is invalid for it.
  std::optional<ClosedLoop> with(const state::ParameterChange& set) const;

  /// The linear plant and the linear control laws of the loop.
  struct Parts {
    LoopPlant plant;
    std::vector<LoopController> controllers;  ///< as controllers()
    HeldMotions about;                        ///< motions about which the plant is linearized
    std::vector<Eigen::VectorXd> outputs;     ///< per controller, at equilibrium; empty: none found
    std::vector<bool> holding;                ///< of each controller: Controller::holds()
  };
  /// Linearization about the closed-loop equilibrium near the present motions; if there is none,
  /// about the systems' equilibria without inputs. The control laws are those at a shaft speed
  /// [rad/s] and the present acceleration of the leading system's shaft. Nothing if a control law
  /// is not linear. Throws RunFailure if the equilibrium requires more than an actuator's limit.
  std::optional<Parts> parts(const SystemMotions& present, double shaft_speed) const;

 private:
  Scene scene_;
  std::vector<std::size_t> controllers_;
  std::vector<std::shared_ptr<const Controller>> laws_;
};

/// All loops of a scene: no two of them have a system in common.
std::vector<ClosedLoop> closedLoops(const Scene& scene);

}  // namespace whirl_twin
