// Settings of a state estimator beside its scene: which parameters to estimate, how far the machine
// may deviate from its model, the rate of false alarms.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/built_scene.h"

namespace whirl_twin {

/// A number to be estimated.
struct EstimatorNumber {
  double deviation = 0.0;  ///< standard deviation at the start; 0: known, not estimated
  double walk = 0.0;       ///< random walk: standard deviation walk sqrt(t) in a time t
};

struct ParameterSettings {
  std::string path;
  EstimatorNumber number;  ///< relative to its value; of a negative one to its magnitude
};

/// A measured input of a system: scale times the channel's value plus offset.
struct InputFollowing {
  std::size_t input = 0;  ///< of the system's inputs
  std::string source;     ///< of the Measurement
  std::string channel;
  std::string unit;        ///< of the input
  double scale = 1.0;      ///< [-]
  double offset = 0.0;     ///< in the input's unit
  double deviation = 0.0;  ///< standard deviation of a sample, in its unit; 0: exact
  bool hold = false;       ///< zero-order hold; else linear
};

struct SystemFollowing {
  std::vector<ParameterSettings> parameters;
  std::vector<InputFollowing> inputs;
  /// White accelerations that are not in the model: [rad/s^2/sqrt(Hz)] or [m/s^2/sqrt(Hz)].
  double disturbance = 0.0;
  EstimatorNumber unbalance;  ///< [kg m], at each station, in addition to the model's
  std::map<std::string, double>
      offset;            ///< standard deviation of a channel's, "source/channel", in its unit
  double run_out = 0.0;  ///< [m], standard deviation under each displacement probe
};

struct FollowSettings {
  std::map<std::string, SystemFollowing> systems;  ///< by name; others: the defaults
  double false_alarms = 0.02;                      ///< per hour, of each kind
  /// Reordering delay [s]: how long a sample waits for those of slower sources. Default: a quarter
  /// of a second plus the longest block of the scene's sensors.
  std::optional<double> patience;

  const SystemFollowing& of(const std::string& system) const {
    static const SystemFollowing kPlain;
    const auto found = systems.find(system);
    return found == systems.end() ? kPlain : found->second;
  }
};

// Settings of a state estimator beside its scene, a YAML map:
//
//   systems:
//     pendulum:
//       disturbance: 0.05                       # rad/s^2/sqrt(Hz), of each coordinate
//       parameters:
//         damping1: 0.5                         # standard deviation, relative to its value
//         coulomb1: {deviation: 0.5, walk: 1e-3}  # and random walk, 1/sqrt(s)
//       inputs:                                 # measured inputs
//         torque1: motors/tau1                  # SOURCE/CHANNEL
//         torque2: {channel: motors/tau2, scale: 0.9, offset: 0.01, deviation: 0.02, hold: true}
//       offsets: {encoders/theta1: 0.01}        # rad, standard deviation; or {encoders:
//                                               # {theta1: 0.01}}, as on a parameter server
//     rotor:
//       unbalance: {deviation: 1e-4, walk: 0.0}   # kg m, added to the scene's, per station
//       run_out: 5e-6                           # m, under each displacement probe
//   false_alarms: 0.02                          # per hour
//   patience: 0.25                              # s, reordering delay; default:
//                                               # 0.25 s + the longest block of the sensors

/// Settings of the systems, parameters and channels of the scene. Throws InputError with all
/// errors, each with `source` and key as prefix.
FollowSettings readFollowSettings(const YAML::Node& tree, const std::string& source,
                                  const BuiltScene& scene);

}  // namespace whirl_twin
