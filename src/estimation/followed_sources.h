// Whose measurements a follower listens to: the sensors of its scene, and the channels that its
// settings name for what acts on inputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "estimation/follow_settings.h"
#include "scene/scene.h"

namespace whirl_twin {

// What acts on an input of a followed machine, as a sensor shows it: held from sample to sample, or
// the straight line between them.

/// A sample of an input.
struct InputSample {
  std::int64_t time = 0;  ///< [ns]
  double value = 0.0;     ///< in the input's unit
};

class FollowedInput {
 public:
  /// deviation: standard deviation of a sample, in the input's unit.
  FollowedInput(bool hold, double deviation) : hold_(hold), deviation_(deviation) {}

  /// The next sample; one that is not later than the last is left out.
  void take(const InputSample& sample);
  /// Instants before this one [ns] are asked for no more.
  void forgetBefore(std::int64_t instant);

  /// Before the first sample it is not.
  bool known() const { return !samples_.empty(); }
  /// An offset [s] after an instant [ns]; beyond the samples the nearest of them.
  double at(std::int64_t instant, double offset) const;
  /// Its samples between two instants [ns]: it has a corner there.
  void addCorners(std::int64_t from, std::int64_t to, std::vector<std::int64_t>& corners) const;
  /// Noise of its samples as white noise [unit^2/Hz]: each lasts to the next.
  double noiseDensity() const { return deviation_ * deviation_ * spacing_; }

 private:
  bool hold_;
  double deviation_;
  double spacing_ = 0.0;  // [s], of the last two samples
  std::deque<InputSample> samples_;
};

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
