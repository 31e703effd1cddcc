// Closed-loop equilibrium (trim): the steady motion in which mechanics and control laws balance,
// about which a loop is linearized. Examples: an arm held up deflects under its load there, a
// rotor's magnetic bearings carry its weight, an engine's governor is at the position of its speed.
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

/// Motion of a system at an instant. The dynamics have the parameters at that instant, and must
/// outlive it.
struct SystemMotion {
  const Dynamics* dynamics;
  Eigen::VectorXd q, v;
  double speed = 0.0;         ///< [rad/s], of its shaft
  double acceleration = 0.0;  ///< [rad/s^2], likewise
};
/// The motion of a system, by its index in the scene.
using SystemMotions = std::function<SystemMotion(std::size_t system)>;

/// A steady motion: constant shape, cyclic coordinates (analysis/cyclic_coordinates.h) at constant
/// rates, constant inputs.
struct ClosedLoopEquilibrium {
  const Dynamics* dynamics;
  Eigen::VectorXd q, v;
  double speed = 0.0;      ///< [rad/s], of the shaft
  Eigen::VectorXd inputs;  ///< in their units, in the order of dynamics->inputs()
};
using HeldMotions = std::map<std::size_t, ClosedLoopEquilibrium>;

/// A controller with a linear discrete-time control law.
struct HoldingLaw {
  const ControllerSpec* controller;
  DiscreteStateSpace law;
  std::vector<double> setpoint;  ///< as Controller::setpoint()
};

struct Held {
  HeldMotions motions;
  std::vector<Eigen::VectorXd> outputs;  ///< of each control law, in units of its inputs acted on
};

/// The equilibria of all systems that these control laws measure or act on, by Newton's method from
/// the present motions. Unknowns that neither stiffness nor control laws determine keep their
/// values. Alternating loads have their mean values; actuator limits are ignored. Nothing if it
/// does not converge.
std::optional<Held> closedLoopEquilibria(const std::vector<HoldingLaw>& laws,
                                         const SystemMotions& present);

}  // namespace whirl_twin
