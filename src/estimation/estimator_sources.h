// Sources of a state estimator's measurements: the sensors of its scene, and the channels that its
// settings assign to inputs.
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

// An input measured by a sensor: zero-order hold or linear interpolation between samples.

/// A sample of an input.
struct InputSample {
  std::int64_t time = 0;  ///< [ns]
  double value = 0.0;     ///< in the input's unit
};

class EstimatorInput {
 public:
  /// deviation: standard deviation of a sample, in the input's unit.
  EstimatorInput(bool hold, double deviation) : hold_(hold), deviation_(deviation) {}

  /// The next sample; ignored unless it is later than the last one.
  void take(const InputSample& sample);
  /// Instants before this one [ns] are no longer needed.
  void forgetBefore(std::int64_t instant);

  /// False before the first sample.
  bool known() const { return !samples_.empty(); }
  /// `offset` [s] after an instant [ns]; outside the samples the nearest one.
  double at(std::int64_t instant, double offset) const;
  /// Adds its samples between two instants [ns] to the breakpoints.
  void addCorners(std::int64_t from, std::int64_t to, std::vector<std::int64_t>& corners) const;
  /// Equivalent density of white noise [unit^2/Hz] of its samples, each held to the next.
  double noiseDensity() const { return deviation_ * deviation_ * spacing_; }

 private:
  bool hold_;
  double deviation_;
  double spacing_ = 0.0;  // [s], of the last two samples
  std::deque<InputSample> samples_;
};

struct EstimatorSource {
  /// A channel of a system: measures its motion or one of its inputs.
  struct Channel {
    std::string name;
    std::string unit;
    double deviation = 0.0;  ///< of its noise, in its unit; 0: not specified
    double delay = 0.0;      ///< [s], of the sensor
    std::size_t system = 0;  ///< of Scene::systems
    SignalSpec signal;
    std::optional<InputFollowing> input;  ///< set: an input, no signal
  };
  std::string name;
  std::optional<KeyphasorSettings> keyphasor;  ///< set: no channels
  std::size_t drive = 0;                       ///< of the keyphasor
  std::vector<Channel> channels;

  std::vector<std::string> names() const;  ///< of its channels
  std::vector<std::string> units() const;
};

/// Sensors of the scene in its order, each with the inputs that it measures, then further sources.
std::vector<EstimatorSource> estimatorSources(const Scene& scene, const FollowSettings& settings);

}  // namespace whirl_twin
