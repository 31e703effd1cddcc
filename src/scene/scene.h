// A validated scene: specification of a simulation, with every number in range. Created by
// readScene() only.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/exclusion_bands.h"
#include "control/input_signal.h"
#include "control/motor.h"
#include "control/speed_profile.h"
#include "models/settings.h"
#include "scene/controller_spec.h"
#include "scene/sensor_spec.h"

namespace whirl_twin {

struct SystemSetup;

/// A rotating shaft, shared by the systems that name it.
struct DriveSpec {
  std::string name;
  double speed = 0.0;              ///< [rad/s], at the scene's start
  double angle = 0.0;              ///< [rad], at the scene's start
  std::vector<SpeedMove> profile;  ///< moves in order; empty: constant speed
  /// A motor instead of a profile: speed and angle are a state of the one system that names it.
  std::optional<Motor> motor = std::nullopt;
  std::vector<SpeedBand> avoid = {};  ///< barred speed ranges, crossed only; unordered
};

/// Distribution of one number over the samples of an ensemble, about the value in the scene; or,
/// without a count of samples, its uncertainty.
struct Spread {
  enum class Kind { kParameter, kCoordinate, kRate };
  std::string path;  ///< `stiffness`, `bearings[0].kxx`, `initial.x`, `initial.x_rate`
  Kind kind = Kind::kParameter;
  std::size_t coordinate = 0;  ///< of an initial value
  bool normal = false;         ///< normal distribution, else uniform
  double width = 0.0;          ///< standard deviation, or half width of the uniform; > 0
};

/// Samples of a system. The system with the values of the scene runs beside them.
struct EnsembleSpec {
  std::size_t count = 0;  ///< samples simulated; 0: no ensemble
  std::uint32_t seed = 1;
  std::vector<Spread> spread;
  /// Lower triangular factor L, n by n: L L^T is the correlation matrix of the spreads; empty:
  /// uncorrelated (ensemble_draw.h).
  Eigen::MatrixXd factor = {};
};

/// A start at the equilibrium for the present parameters.
struct EquilibriumStart {
  double speed = 0.0;  ///< [rad/s], of the shaft
  bool asked = false;  ///< required by the scene; else by default
};

struct SystemSpec {
  std::string name;
  std::string model;
  std::optional<std::string> drive;  ///< name of its drive
  std::size_t drive_place = 0;       ///< index where Scene::driveOf() searches first
  std::optional<double> speed;       ///< [rad/s], a constant speed instead of a drive
  std::string integrator = "auto";
  double tolerance = 1.0e-6;  ///< [-], for auto
  double horizon = 10.0;      ///< [s], for auto
  int substeps = 1;
  /// What `auto` resolves to, as far as a calibration has determined it (step_choice.h), and why.
  std::string chosen_integrator = "";
  std::string choice_reason = "";
  std::map<std::string, double> parameters;  ///< complete: defaults filled in
  /// Parameters that are not given and default to the value of another one: stiffness_y to
  /// stiffness. setParameter() changes them together.
  std::map<std::string, std::string> following;
  Settings settings;                          ///< parameters other than single numbers
  std::vector<double> q;                      ///< initial coordinates, [rad] or [m]
  std::vector<double> v;                      ///< initial rates, [rad/s] or [m/s]
  std::optional<EquilibriumStart> rest;       ///< q and v are an equilibrium; else as given
  std::map<std::string, InputSignal> inputs;  ///< by the input names of its model
  EnsembleSpec ensemble;
  /// Setup made by the reader from the above, reused by build() (system_setup.h).
  std::shared_ptr<const SystemSetup> setup = nullptr;
};

struct Scene {
  std::string source;  ///< origin, for messages
  std::string name;
  std::int64_t step = 0;     ///< [ns], the fixed step
  std::int64_t time = 0;     ///< [ns], simulated time at the start
  double gravity = 9.80665;  ///< [m/s^2]
  std::vector<DriveSpec> drives;
  std::vector<SystemSpec> systems;
  std::vector<SensorSpec> sensors;
  std::vector<ControllerSpec> controllers;

  /// Index in `drives` of the drive of a system; drives.size() if it has none.
  std::size_t driveOf(const SystemSpec& system) const {
    if (!system.drive) {
      return drives.size();
    }
    const auto is_it = [&](const DriveSpec& drive) { return drive.name == *system.drive; };
    if (system.drive_place < drives.size() && is_it(drives[system.drive_place])) {
      return system.drive_place;
    }
    const auto found = std::find_if(drives.begin(), drives.end(), is_it);
    return static_cast<std::size_t>(found - drives.begin());
  }

  double stepSeconds() const { return static_cast<double>(step) * 1.0e-9; }
};

}  // namespace whirl_twin
