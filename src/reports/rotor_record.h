// What a recording, LCM log or rosbag, holds of a running rotor: the samples of its displacement
// probes with the angle of its shaft from the keyphasor's pulses, as `twin simulate --measure`
// writes them and an acquisition beside a machine would; where there are no measurements, the whirl
// that a twin published.
#pragma once

#include <complex>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "estimation/unbalance_fit.h"
#include "messages/measurement.h"
#include "reports/output.h"
#include "reports/recording.h"
#include "reports/rotor_systems.h"

namespace whirl_twin {

/// A displacement probe at a station of the rotor.
struct RecordedProbe {
  std::string name;                ///< of its channel; of several sources SOURCE/CHANNEL
  std::size_t station = 0;         ///< of the rotor's stations
  double direction = 0.0;          ///< [rad], across the shaft, from +x towards +y
  double deviation = 0.0;          ///< [m], of its noise, as in the messages; 0: not given
  double delay = 0.0;              ///< [s], as in the scene
  double bandwidth = 0.0;          ///< [Hz], likewise; 0: no filter
  std::complex<double> run_out{};  ///< [m], likewise, as in unbalance_fit.h
};

/// What has become of what the log holds.
struct RecordCounts {
  std::int64_t samples = 0;    ///< with an angle
  std::int64_t no_angle = 0;   ///< samples while the angle of the shaft was not known
  std::int64_t not_valid = 0;  ///< values of probes
  std::int64_t pulses = 0;     ///< that were taken
  std::int64_t false_pulses = 0, missing_pulses = 0;
  double jitter = 0.0;  ///< [s], standard deviation of a pulse's instant at the end of the log
  bool stated = true;   ///< that is the one that the scene states

  /// What a reader should know of the pulses; "": nothing.
  std::string pulseNote() const;
  /// Adds the counts to the JSON of a report; `used`: samples.
  void addTo(Json& json, std::int64_t used) const;
};

/// Which sources of probes are read: all, so that a reading has the probes of one or more of them,
/// or those with samples at the instants of the one with the most probes, so that it has them all.
enum class ProbesRead { kAll, kAtSameInstants };

class RotorRecord {
 public:
  /// Looks through the log. Throws InputError where it holds nothing of the rotor that could be
  /// used, with what was expected, and as readRecording() does.
  RotorRecord(const BuiltScene& scene, const RotorSystem& system, const Recording& recording,
              ProbesRead probes = ProbesRead::kAll);

  const std::string& log() const { return recording_.path; }
  const std::vector<RecordedProbe>& probes() const { return probes_; }
  /// Of sources of the scene that are not read, and why.
  const std::vector<std::string>& notes() const { return notes_; }
  /// [s], from sample to sample of the source with the most probes.
  double period() const { return period_; }
  /// [rad/s], about which the shaft kept within 1 % for the longest time.
  double steadySpeed() const { return steady_speed_; }

  /// Goes through the log again and gives each sample that has an angle.
  RecordCounts read(const std::function<void(const ProbeReading&)>& take) const;

 private:
  void findProbes(const BuiltScene& scene, const RotorSystem& system, ProbesRead which);
  void findWhirl(const RotorSystem& system);
  RecordCounts readProbes(const std::function<void(const ProbeReading&)>& take) const;
  RecordCounts readWhirl(const std::function<void(const ProbeReading&)>& take) const;
  LoggedMessages eachMessage(const std::function<void(const Message&)>& take) const;

  struct ProbeSource {
    std::string name;
    std::vector<std::string> channels;
    std::size_t first = 0;  // of probes_
  };

  Recording recording_;
  std::vector<EstimatorSource> measured_;  // by the sensors of the scene
  std::vector<RecordedProbe> probes_;
  std::vector<ProbeSource> sources_;
  std::vector<std::string> notes_;
  KeyphasorSettings keyphasor_;
  std::vector<std::int64_t> pulses_;                     // [ns]
  std::set<std::pair<std::string, std::int64_t>> wild_;  // name of a probe, instant [ns]
  std::vector<std::string> whirls_;  // systems, as published, of two probes each
  double period_ = 0.0;
  double steady_speed_ = 0.0;
};

}  // namespace whirl_twin
