// Orbit of a shaft from two displacement probes and a keyphasor: converts their messages into
// ordered samples with the angle of the shaft.
//
// A probe along a direction a measures x cos a + y sin a; two of different directions, at any angle
// to one another, give x and y. A sample waits for the pulse that follows it, so that the angle is
// known from both sides; where none arrives in time, as at standstill, the angle is predicted;
// where the uncertainty of that exceeds half a turn the sample has speed 0: no orders.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "messages/measurement.h"
#include "signal/orbit_window.h"
#include "signal/outliers.h"
#include "signal/shaft_tracker.h"

namespace whirl_twin {

struct MeasuredProbe {
  std::string source;      ///< of the messages
  std::string channel;     ///< of theirs
  double direction = 0.0;  ///< [rad], from +x towards +y
};

struct MeasuredOrbitSettings {
  std::array<MeasuredProbe, 2> probes;
  std::string keyphasor;  ///< source of its messages; each sample is a pulse
  ShaftTrackerSettings shaft;
  double longest_wait = 0.5;  ///< [s], of a sample for the next pulse
};

/// Counts of the samples of both probes, and of the reasons for rejection.
struct SampleCounts {
  std::int64_t used = 0;     ///< of either probe
  std::int64_t invalid = 0;  ///< marked invalid, or in a unit that is not a length
  std::int64_t not_finite = 0;
  std::int64_t repeated = 0;  ///< of the same instant as the one before
  std::int64_t late = 0;      ///< of an instant before an accepted one
  std::int64_t alone = 0;     ///< no sample of the other probe at that instant
  std::int64_t wild = 0;      ///< outliers (outliers.h)
};

class MeasuredOrbit {
 public:
  /// Two directions [rad] differ, and not by half a turn.
  static bool makeAnOrbit(double first, double second);
  /// The directions of the probes make an orbit; else std::invalid_argument.
  explicit MeasuredOrbit(const MeasuredOrbitSettings& settings);

  /// Whether messages of this source are any of its business.
  bool listensTo(const std::string& source) const;
  /// Processes the next message; appends the samples that are then complete. Messages of other
  /// sources are ignored.
  void take(const state::Measurement& message, std::vector<OrbitSample>& out);
  /// What still waits, as no pulse will follow.
  void finish(std::vector<OrbitSample>& out);
  /// Restarts, as after time was set back; counters continue.
  void clear();

  const SampleCounts& samples() const { return samples_; }
  const ShaftTracker& shaft() const { return shaft_; }
  ShaftEstimate shaftAt(std::int64_t instant) const { return shaft_.at(instant); }
  /// [ns], from which OrbitSample::time counts: 0, or where instants are those of a clock the first
  /// sample's, as a double does not resolve those.
  std::int64_t origin() const { return origin_; }

 private:
  struct Reading {
    std::int64_t instant = 0;  // [ns]
    std::int64_t period = 0;   // [ns], from sample to sample; 0: not known
    double value = 0.0;        // [m]
  };

  void takeProbe(std::size_t probe, const state::Measurement& message);
  void leaveOutWild(std::size_t probe);
  void takePulses(const state::Measurement& message);
  void advance(std::vector<OrbitSample>& out, double longest_wait);
  bool paired();
  OrbitSample sample(const Reading& first, const Reading& second);

  MeasuredOrbitSettings settings_;
  std::array<std::array<double, 2>, 2> inverse_{};  // x and y of the two readings
  ShaftTracker shaft_;
  std::array<std::deque<Reading>, 2> readings_;  // that wait
  std::array<WildSampleDetector, 2> wild_;
  std::array<std::int64_t, 2> newest_reading_{};  // [ns]
  std::deque<std::int64_t> pulses_;               // [ns], that wait for samples
  std::int64_t newest_ = 0;                       // [ns], of anything
  std::int64_t last_ = 0;                         // [ns], of the sample given last
  std::int64_t index_ = 0;                        // of that
  std::int64_t origin_ = 0;                       // [ns]
  SampleCounts samples_;
};

}  // namespace whirl_twin
