// The models of the twin's scene, /twin/scene, for displays. Without a scene, or with an invalid
// one, no system has a model.
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

// Measured position of a system: the coordinates of the newest sample, from a source of the scene
// that measures each coordinate of the system.

class MeasuredPlace {
 public:
  /// For a system of the scene, from its first suitable source; none: no source measures all of its
  /// coordinates, or it is a rotor, whose whirl is drawn magnified.
  static std::optional<MeasuredPlace> of(const BuiltScene& scene, const std::string& system);

  /// The source of the measurement.
  const std::string& source() const { return source_; }

  /// Coordinates [m or rad] of the newest sample of a block with all channels valid; empty: no such
  /// sample, or the block lacks channels, or has incompatible units.
  std::vector<double> newest(const Measurement& block) const;

 private:
  std::string source_;
  // Of each coordinate:
  std::vector<std::string> channel_;
  std::vector<std::string> unit_;
};

class SceneDynamics {
 public:
  /// Reads the scene; true if it differs from the previous one.
  bool refresh();

  /// Applies changed parameters; false if they are not of this scene.
  bool take(const ParameterChange& change);

  /// The model of a system; null if unknown.
  std::shared_ptr<const Dynamics> dynamics(const std::string& system) const;

  /// The system for which a whirl is published under this name: the system itself, or one with this
  /// station.
  std::string systemOf(const std::string& published) const;

  /// Name of the drive of a system; "" without one.
  std::string driveOf(const std::string& system) const;

  /// Actuator limit of a controller, in the unit of its outputs; infinite: no limit, or no such
  /// controller.
  double actuatorLimit(const std::string& controller) const;

  /// The position of a system as measured by sensors of the scene; none: not measured.
  std::optional<MeasuredPlace> measuredPlace(const std::string& system) const;

  /// The motion of a system's shaft at a time [s], simulated.
  /// @param drive the latest state of its drive; null without one
  EvaluationPoint<double> shaft(const std::string& system, double time,
                                const DriveState* drive) const;

 private:
  std::string tree_;                             // of parameters, as last read
  std::map<std::string, SharedSystem> systems_;  // with their current parameters
  std::map<std::string, MeasuredPlace> measured_;
  std::map<std::string, double> actuator_limits_;  // of each controller
};

}  // namespace whirl_twin
