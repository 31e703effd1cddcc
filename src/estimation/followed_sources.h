// Whose measurements a follower listens to: the sensors of its scene, and the channels that its
// settings name for what acts on inputs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "estimation/follow_settings.h"
#include "scene/scene.h"

namespace whirl_twin {

struct FollowedSource {
  /// Of a system: its motion, or what acts on one of its inputs.
  struct Channel {
    std::string name;
    std::string unit;
    double deviation = 0.0;  ///< of its noise, in its unit; 0: not said
    double delay = 0.0;      ///< [s], that it shows the machine late by
    std::size_t system = 0;  ///< of Scene::systems
    SignalSpec signal;
    std::optional<InputFollowing> input;  ///< then there is no signal
  };
  std::string name;
  std::optional<KeyphasorSettings> keyphasor;  ///< then there are no channels
  std::size_t drive = 0;                       ///< of the keyphasor
  std::vector<Channel> channels;

  std::vector<std::string> names() const;  ///< of its channels
  std::vector<std::string> units() const;
};

/// Sensors of the scene in its order, each with the inputs that it measures, then further sources.
std::vector<FollowedSource> followedSources(const Scene& scene, const FollowSettings& settings);

}  // namespace whirl_twin
