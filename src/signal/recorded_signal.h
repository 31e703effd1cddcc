// Signals of a recording: the shaft between the pulses of its keyphasor, the speed that it kept for
// longest, and the samples of a channel that are implausible (outliers.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "control/keyphasor.h"
#include "signal/outliers.h"
#include "signal/shaft_tracker.h"

namespace whirl_twin {

/// Wild samples of a channel.
struct WildSamples {
  WildSampleDetector detector;
  std::vector<std::int64_t> instants;  ///< [ns]
  double largest = 0.0;                ///< of all samples, without sign

  /// The next sample, at an instant [ns] later than the one before; finite.
  void take(std::int64_t instant, double value);
};

/// The speed about which, within 1 %, the most time was spent, of speeds above 0 and the times [s]
/// spent at them.
double longestKeptSpeed(std::vector<std::pair<double, double>> dwells);
/// Likewise of a shaft with pulses at these instants [ns], one a turn.
double longestKeptSpeed(const std::vector<std::int64_t>& pulses);

/// The shaft between recorded pulses, at instants in order.
class RecordedShaft {
 public:
  RecordedShaft(const KeyphasorSettings& keyphasor, const std::vector<std::int64_t>& pulses);

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
