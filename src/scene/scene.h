// A checked scene: what is simulated, with every number in range. Made by readScene() only.
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

/// A shaft that turns, shared by the systems that name it.
struct DriveSpec {
  std::string name;
  double speed = 0.0;              ///< [rad/s], at the scene's start
  double angle = 0.0;              ///< [rad], at the scene's start
  std::vector<SpeedMove> profile;  ///< moves in order; empty: the speed stays
  /// It turns the shaft instead: speed and angle are a state of the one system that names it.
  std::optional<Motor> motor = std::nullopt;
  std::vector<SpeedBand> avoid = {};  ///< that it passes and does not stay in; in no order
};

/// How one number differs from member to member of an ensemble, about what the scene gives; or,
/// without a count of members, how well it is known.
struct Spread {
  enum class Kind { kParameter, kCoordinate, kRate };
  std::string path;  ///< `stiffness`, `bearings[0].kxx`, `initial.x`, `initial.x_rate`
  Kind kind = Kind::kParameter;
  std::size_t coordinate = 0;  ///< of an initial value
  bool normal = false;         ///< distributed normally, else uniformly
  double width = 0.0;          ///< standard deviation, or half the uniform's width; > 0
};

/// A system many times over. The system itself, as the scene gives it, runs beside them.
struct EnsembleSpec {
  std::size_t count = 0;  ///< members that run; 0: no ensemble
  std::uint32_t seed = 1;
  std::vector<Spread> spread;
  /// Lower triangular, n by n: times its transpose the correlations of the spreads; empty: none
  /// (spread_correlations.h).
  Eigen::MatrixXd factor = {};
};

/// A start at the equilibrium of the parameters there are.
struct EquilibriumStart {
  double speed = 0.0;  ///< [rad/s], of the shaft
  bool asked = false;  ///< by the scene; else by default
};

struct SystemSpec {
  std::string name;
  std::string model;
  std::optional<std::string> drive;  ///< name of the drive that turns it
  std::size_t drive_place = 0;       ///< where Scene::driveOf() looks for it first
  std::optional<double> speed;       ///< [rad/s], a constant speed of its own instead
  std::string integrator = "auto";
  double tolerance = 1.0e-6;  ///< [-], for auto
  double horizon = 10.0;      ///< [s], for auto
  int substeps = 1;
  /// What `auto` stands for, as far as a calibration has found out (step_choice.h), and why.
  std::string chosen_integrator = "";
  std::string choice_reason = "";
  std::map<std::string, double> parameters;  ///< complete: defaults filled in
  /// Parameters that are not given and have the value of another by default: stiffness_y its
  /// stiffness. setParameter() changes them along.
  std::map<std::string, std::string> following;
  Settings settings;                          ///< parameters that are not one number
  std::vector<double> q;                      ///< initial coordinates, [rad] or [m]
  std::vector<double> v;                      ///< initial rates, [rad/s] or [m/s]
  std::optional<EquilibriumStart> rest;       ///< q and v are an equilibrium; else as given
  std::map<std::string, InputSignal> inputs;  ///< what acts on it, by the names of its model
  EnsembleSpec ensemble;
  /// What reading set up of the above, for build() to take over (system_setup.h).
  std::shared_ptr<const SystemSetup> setup = nullptr;
};

struct Scene {
  std::string source;  ///< where it came from, for messages
  std::string name;
  std::int64_t step = 0;     ///< [ns], the fixed step
  std::int64_t time = 0;     ///< [ns], simulated time at the start
  double gravity = 9.80665;  ///< [m/s^2]
  std::vector<DriveSpec> drives;
  std::vector<SystemSpec> systems;
  std::vector<SensorSpec> sensors;
  std::vector<ControllerSpec> controllers;

  /// Place in `drives` of the one that turns the system; drives.size() if none does.
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
