// What a follower is told beside its scene: which parameters to follow, how far the machine may
// depart from its model, how often a false alarm may be.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/built_scene.h"

namespace whirl_twin {

/// A number of which more is found out on the way.
struct FollowedNumber {
  double deviation = 0.0;  ///< standard deviation at the start; 0: known, not followed
  double walk = 0.0;       ///< its own change in a time t has the standard deviation walk sqrt(t)
};

struct ParameterSettings {
  std::string path;
  FollowedNumber number;  ///< in parts of its value, of a negative one of its size
};

/// What acts on an input of a system is measured: scale times what a channel shows, and an offset.
struct InputFollowing {
  std::size_t input = 0;  ///< of the system's inputs
  std::string source;     ///< of the Measurement
  std::string channel;
  std::string unit;        ///< of the input
  double scale = 1.0;      ///< [-]
  double offset = 0.0;     ///< in the input's unit
  double deviation = 0.0;  ///< standard deviation of a sample, in its unit; 0: it is exact
  bool hold = false;       ///< from sample to sample; else linear
};

struct SystemFollowing {
  std::vector<ParameterSettings> parameters;
  std::vector<InputFollowing> inputs;
  /// Accelerations that the model has not, white: [rad/s^2/sqrt(Hz)] or [m/s^2/sqrt(Hz)].
  double disturbance = 0.0;
  FollowedNumber unbalance;  ///< [kg m], at each station, beside the model's own
  std::map<std::string, double>
      offset;            ///< deviation of a channel's, "source/channel", in its unit
  double run_out = 0.0;  ///< [m], deviation of that under each displacement probe
};

struct FollowSettings {
  std::map<std::string, SystemFollowing> systems;  ///< by their names; others: as by default
  double false_alarms = 0.02;                      ///< an hour, of each kind
  /// [s], that a sample waits for those of slower sources. Else a quarter of a second and the
  /// longest block of the scene's sensors.
  std::optional<double> patience;

  const SystemFollowing& of(const std::string& system) const {
    static const SystemFollowing kPlain;
    const auto found = systems.find(system);
    return found == systems.end() ? kPlain : found->second;
  }
};

// Reads what a follower is told beside its scene, a YAML map:
//
//   systems:
//     pendulum:
//       disturbance: 0.05                       # rad/s^2/sqrt(Hz), of each coordinate
//       parameters:
//         damping1: 0.5                         # what may be wrong with it, in parts of its value
//         coulomb1: {deviation: 0.5, walk: 1e-3}  # and what it changes by, in a second
//       inputs:                                 # what acts on them, where it is measured
//         torque1: motors/tau1                  # SOURCE/CHANNEL
//         torque2: {channel: motors/tau2, scale: 0.9, offset: 0.01, deviation: 0.02, hold: true}
//       offsets: {encoders/theta1: 0.01}        # rad, what zeros may be off by; or {encoders:
//                                               # {theta1: 0.01}}, as on a parameter server
//     rotor:
//       unbalance: {deviation: 1e-4, walk: 0.0}   # kg m, beside the scene's, at each station
//       run_out: 5e-6                           # m, under each displacement probe
//   false_alarms: 0.02                          # an hour
//   patience: 0.25                              # s, that samples wait for slower sources; else
//                                               # 0.25 s and the longest block of the sensors

/// Of the systems, parameters and channels of the scene. Throws Refusal with every complaint, each
/// with `source` and key before it.
FollowSettings readFollowSettings(const YAML::Node& tree, const std::string& source,
                                  const BuiltScene& scene);

}  // namespace whirl_twin
