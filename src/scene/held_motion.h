// Where controllers hold systems: the steady motion in which mechanics and laws balance. An arm
// held aloft bends away from the load there, a rotor's magnets carry its weight, an engine's
// governor stands where its speed puts it: that is what a loop's small motions are about.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "controllers/controller.h"
#include "mechanics/dynamics.h"
#include "scene/controller_spec.h"

namespace whirl_twin {

/// A moment of a system. Its dynamics are with their parameters of that moment, and outlive it.
struct SystemMotion {
  const Dynamics* dynamics;
  Eigen::VectorXd q, v;
  double speed = 0.0;         ///< [rad/s], of its shaft
  double acceleration = 0.0;  ///< [rad/s^2], likewise
};
/// Of a system, by its place in the scene.
using SystemMotions = std::function<SystemMotion(std::size_t system)>;

/// A steady motion: the shape rests, cyclic coordinates (analysis/cyclic_coordinates.h) move at
/// constant rates, inputs are constant.
struct HeldMotion {
  const Dynamics* dynamics;
  Eigen::VectorXd q, v;
  double speed = 0.0;      ///< [rad/s], of the shaft
  Eigen::VectorXd inputs;  ///< in their units, in the order of the dynamics'
};
using HeldMotions = std::map<std::size_t, HeldMotion>;

/// A controller with a law that is linear in samples.
struct HoldingLaw {
  const ControllerSpec* controller;
  DiscreteStateSpace law;
  std::vector<double> setpoint;  ///< as Controller::setpoint()
};

struct Held {
  HeldMotions motions;
  std::vector<Eigen::VectorXd> outputs;  ///< of each law, in units of what it acts on
};

/// Of all systems that these laws measure or act on, by Newton's method from where they are. What
/// neither stiffness nor law decides stays as it is. Loads that alternate are at their mean; limits
/// of actuators are not looked at. Nothing if it does not converge.
std::optional<Held> heldMotions(const std::vector<HoldingLaw>& laws, const SystemMotions& present);

}  // namespace whirl_twin
