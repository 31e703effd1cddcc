// The models of the twin's scene, /twin/scene, for displays. Without a scene, or with one that is
// not right, nothing is known of any system.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "display/measured_place.h"
#include "mechanics/dynamics.h"
#include "scene/built_scene.h"
#include "whirl_twin/DriveState.h"
#include "whirl_twin/ParameterChange.h"

namespace whirl_twin {

class SceneDynamics {
 public:
  /// Reads the scene; true if it is not the one that was there before.
  bool refresh();

  /// Takes over changed parameters; false if they are not of this scene.
  bool take(const ParameterChange& change);

  /// The model of a system; null if it is not known.
  std::shared_ptr<const Dynamics> dynamics(const std::string& system) const;

  /// The system that a whirl of this name is published of: that itself, or of which it is a
  /// station.
  std::string systemOf(const std::string& published) const;

  /// Name of the drive that turns a system; "" without one.
  std::string driveOf(const std::string& system) const;

  /// What the actuators of a controller can give, in the unit of its outputs; infinite: there is no
  /// limit, or no such controller.
  double actuatorLimit(const std::string& controller) const;

  /// How sensors of the scene show where a system is; none: they do not.
  std::optional<MeasuredPlace> measuredPlace(const std::string& system) const;

  /// The motion of a system's shaft at a time [s], simulated.
  /// @param drive the latest state of its drive; null without one
  Moment<double> shaft(const std::string& system, double time, const DriveState* drive) const;

 private:
  std::string tree_;                             // of parameters, as they were read last
  std::map<std::string, SharedSystem> systems_;  // with their parameters as they are now
  std::map<std::string, MeasuredPlace> measured_;
  std::map<std::string, double> actuator_limits_;  // of each controller
};

}  // namespace whirl_twin
