// Controllers that hang together, by systems that they share, and the loop that they close.
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
  /// Of these controllers of a scene, with the laws that they have at its start.
  ClosedLoop(const Scene& scene, std::vector<std::size_t> controllers);

  const std::vector<std::size_t>& controllers() const { return controllers_; }
  std::vector<std::size_t> systems() const;                ///< ascending
  const ControllerSpec& controller(std::size_t i) const {  ///< i-th of controllers()
    return scene_.controllers[controllers_[i]];
  }
  const std::string& nameOf(std::size_t system) const { return scene_.systems[system].name; }
  /// Whose shaft's speed the laws follow: the first system that the first controller measures.
  std::size_t leadingSystem() const { return controller(0).measures.front().system; }
  bool has(const std::string& controller) const;
  /// The numbers of one that it has.
  state::ParameterChange parametersOf(const std::string& controller) const;

  /// With the complete set of numbers that a twin told of one of its controllers; nothing where it
  /// has none of that name, or one that cannot have them.
  std::optional<ClosedLoop> with(const state::ParameterChange& set) const;

  /// The plant and the laws that close the loop around it.
  struct Parts {
    LoopPlant plant;
    std::vector<LoopController> controllers;  ///< as controllers()
    HeldMotions about;                        ///< what the plant's motions are small about
    std::vector<Eigen::VectorXd> outputs;     ///< of each controller there; none: it holds nothing
    std::vector<bool> holding;                ///< of each controller: Controller::holds()
  };
  /// For small motions about those that the laws hold the systems in, from where these are at
  /// present; where nothing is held, about the rests near by. Laws are those of a shaft speed
  /// [rad/s] and the present acceleration of the leading system's shaft. Nothing where a law is not
  /// linear. Throws RunFailure where an actuator's limit is less than what it takes to hold them.
  std::optional<Parts> parts(const SystemMotions& present, double shaft_speed) const;

 private:
  Scene scene_;
  std::vector<std::size_t> controllers_;
  std::vector<std::shared_ptr<const Controller>> laws_;
};

/// All loops of a scene: no two of them have a system in common.
std::vector<ClosedLoop> closedLoops(const Scene& scene);

}  // namespace whirl_twin
