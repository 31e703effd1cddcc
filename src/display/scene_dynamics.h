// The models of the twin's scene, /twin/scene, for displays. Without a scene, or with one that is
// not right, nothing is known of any system.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "scene/built_scene.h"
#include "whirl_twin/DriveState.h"
#include "whirl_twin/Measurement.h"
#include "whirl_twin/ParameterChange.h"

namespace whirl_twin {

// Where sensors show a system to be: the coordinates of the newest sample, of a source of the scene
// that measures each coordinate of the system.

class MeasuredPlace {
 public:
  /// Of a system of the scene, by its first source that will do; none: no source measures all of
  /// its coordinates, or it is a rotor, whose whirl is drawn larger than it is.
  static std::optional<MeasuredPlace> of(const BuiltScene& scene, const std::string& system);

  /// The source whose blocks show it.
  const std::string& source() const { return source_; }

  /// Coordinates [m or rad] of the newest sample of a block of which each is valid; empty: there
  /// is none, or the block has not the channels, or in units of another kind.
  std::vector<double> newest(const Measurement& block) const;

 private:
  std::string source_;
  // Of each coordinate:
  std::vector<std::string> channel_;
  std::vector<std::string> unit_;
};

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
