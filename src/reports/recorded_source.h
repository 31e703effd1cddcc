// What a recording has of one source of measurements: how many samples, how far apart, which of
// them are wild; and the shaft between the pulses of its keyphasor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "control/keyphasor.h"
#include "messages/measurement.h"
#include "scene/scene.h"
#include "signal/outliers.h"
#include "signal/shaft_tracker.h"

namespace whirl_twin {

/// Wild samples of a channel (wild_samples.h).
struct WildSamples {
  WildSampleDetector detector;
  std::vector<std::int64_t> instants;  ///< [ns]
  double largest = 0.0;                ///< [m], without sign, of the source's largest value

  /// How many, and when the first, in words; `start`: [ns], of the recording.
  std::string note(const std::string& probe, std::int64_t start) const;
};

/// A source of probes, or a keyphasor, and what the log has of it.
struct RecordedSource {
  const SensorSpec* spec = nullptr;
  std::int64_t samples = 0;                 ///< each later than all before
  std::int64_t first = 0, last = 0;         ///< [ns]
  std::map<std::string, double> deviation;  ///< [m], of its channels, as the first message says
  std::map<std::string, WildSamples> wild;  ///< of its channels

  void take(const state::Measurement& message);
  double period() const;  ///< [s]
  /// Its samples are those of the instants of the other.
  bool isAtInstantsOf(const RecordedSource& other) const;
};

/// [-], of a period: samples that are less apart are of one instant.
inline constexpr double kTogether = 1.0e-3;

/// The shaft between pulses, at instants in order.
class TrackedShaft {
 public:
  TrackedShaft(const KeyphasorSettings& keyphasor, const std::vector<std::int64_t>& pulses);

  /// Known: to a tenth of a radian.
  ShaftEstimate at(std::int64_t instant);
  const PulseCounts& counts() const { return tracker_.counts(); }
  /// [s], standard deviation of a pulse's instant; more than stated where the pulses show it.
  double jitter() const { return tracker_.jitter(); }
  bool scattersAsStated() const { return tracker_.jitter() == stated_; }

 private:
  ShaftTracker tracker_;
  double stated_;  // [s]
  const std::vector<std::int64_t>& pulses_;
  std::size_t next_ = 0;
};

}  // namespace whirl_twin
