// Simulated measurements of the sensors of a scene: blocks of samples, and keyphasor pulses, as
// sent by a data acquisition system.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "control/keyphasor.h"
#include "control/sensor.h"
#include "messages/measurement.h"
#include "scene/built_scene.h"
#include "scene/sensor_spec.h"
#include "twin/observer.h"

namespace whirl_twin {

/// A source of measurements. Follows the observer from record to record; not for the real-time
/// thread.
class MeasuredSource {
 public:
  /// Starts at the observer's last record.
  MeasuredSource(const SensorSpec& spec, const BuiltScene& scene, const Observer& observer);

  /// The observer's current record, at most one step later; complete messages are appended to
  /// `out`.
  void observe(const Observer& observer, std::vector<state::Measurement>& out);
  /// The remaining samples, as a shorter message.
  void finish(std::vector<state::Measurement>& out);

 private:
  /// Value of a signal at a record.
  struct Point {
    double value = 0.0;
    double rate = 0.0;
  };
  struct Channel {
    SensorChannelSpec spec;
    std::optional<Station> station;  ///< of a displacement
    Sensor sensor;
    Point last;
    std::int64_t next = 0;       ///< next sample
    std::deque<Sample> waiting;  ///< until the samples of the other channels are available
  };

  Point signal(const Channel& channel, const Observer& observer) const;
  ShaftInstant shaft(const Observer& observer) const;
  void sampleChannel(Channel& channel, const Point& now, std::int64_t time);
  void collectSamples(std::vector<state::Measurement>& out);
  void collectPulses(const Observer& observer, std::vector<state::Measurement>& out);
  void send(std::vector<state::Measurement>& out);

  SensorSpec spec_;
  std::vector<SharedSystem> systems_;
  std::int64_t start_ns_;  ///< of the scene
  std::int64_t step_ns_;
  std::int64_t time_;                       ///< [ns], of the newest record
  std::optional<SampleInstants> instants_;  ///< of all channels
  std::vector<Channel> channels_;
  std::optional<Keyphasor> keyphasor_;
  ShaftInstant shaft_;  ///< at the newest record
  std::int64_t last_pulse_ = std::numeric_limits<std::int64_t>::min() / 2;  ///< [ns]
  std::int64_t first_ = 0;      ///< first sample of the block
  std::int64_t block_ = 1;      ///< samples in a message
  std::int64_t block_end_ = 0;  ///< [ns], of a keyphasor's message
  state::Measurement message_;  ///< under construction
};

/// The sensors of a scene, by these names.
class Measurements {
 public:
  Measurements(const std::vector<SensorSpec>& sensors, const BuiltScene& scene,
               const Observer& observer);

  /// As MeasuredSource::observe(); the complete messages of all sensors.
  std::vector<state::Measurement> observe(const Observer& observer);
  std::vector<state::Measurement> finish();

 private:
  std::vector<MeasuredSource> sources_;
};

}  // namespace whirl_twin
