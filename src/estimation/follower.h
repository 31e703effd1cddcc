// A twin that follows its machine: measurements go in, records of a twin come out, as if it had
// been stepped, and beside them what has been learned of the machine.
//
// Instants are the machine's. The first sample is the scene's start; from there on the twin's steps
// count along the machine's clock. A system without a sample yet stands as the scene says, and so
// does one on a shaft that nothing is heard of, for a second: then, and where pulses cease, it is
// followed by its probes alone. Where samples cease for a second, or the machine's clock is
// set, the motion is found anew and what was learned is kept; the twin's time goes on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "estimation/follow_settings.h"
#include "estimation/followed_shaft.h"
#include "estimation/followed_sources.h"
#include "estimation/followed_track.h"
#include "estimation/measured_queue.h"
#include "messages/follow_state.h"
#include "messages/measurement.h"
#include "twin/system_generations.h"
#include "twin/twin.h"

namespace whirl_twin {

/// Who is told of what a follower finds, in the order of the twin's steps.
struct FollowerListener {
  std::function<void(const double* record)> record;
  std::function<void(const state::FollowState&)> follow;
};

class Follower {
 public:
  /// Of a twin whose scene says by its sensors what is measured; it is not stepped. every: steps
  /// from one record to the next. Throws Refusal for a scene of which nothing is measured.
  Follower(const Twin& twin, std::shared_ptr<SystemGenerations> generations,
           const FollowSettings& settings, std::int64_t every, FollowerListener listener);
  ~Follower();

  /// The next message; those of sources that the scene has not are left alone.
  void take(const state::Measurement& message);
  /// No more messages will come.
  void finish();

  /// Of a system that is measured; nullptr: it is not.
  const SystemFilter* filter(std::size_t system) const;
  /// Of all that its filter has learned: standard deviations over those of its covariance.
  const Eigen::VectorXd& deviationFactors(std::size_t system) const;
  /// [ns], of the machine's clock.
  std::int64_t machineInstant(std::int64_t step) const;
  /// Root mean square of the residuals of each channel, from when its motion was found; NaN: none.
  std::vector<double> residualRms(std::size_t system) const;
  /// How often a motion had to be found anew.
  std::int64_t restarts() const { return restarts_; }
  /// How often the machine's clock was set.
  std::int64_t clockSettings() const { return clock_settings_; }

 private:
  struct Channel {
    std::size_t system = 0;
    std::size_t place = 0;   // in its filter
    std::int64_t delay = 0;  // [ns], that it shows the machine late by
    std::optional<InputFollowing> input = std::nullopt;
  };
  /// What measures an input.
  struct Input {
    std::size_t system, source, channel;
  };
  struct Shaft {
    FollowedShaft motion;
    std::optional<std::size_t> source;  // of its pulses
  };

  void addSensors(const FollowSettings& settings);
  void process();
  void takePulse(std::size_t drive, const MeasuredSample& pulse);
  void takeSample(const MeasuredSample& sample);
  void takeInput(const Channel& channel, const MeasuredSample& sample);
  void takeNextInputs(FollowedTrack& system);
  void stepUntil(std::int64_t instant);
  void writeRecord(std::int64_t step);
  /// [J], of a system as it stands in the record, v dL/dv - L.
  double heldEnergy(const FollowedTrack& followed) const;
  void tellState(FollowedTrack& system);
  void begin(std::int64_t instant);
  ShaftEstimate shaftAt(std::size_t drive, std::int64_t instant);
  ShaftEstimate shaftOf(const FollowedTrack& system, std::int64_t instant);

  const Twin& twin_;
  std::shared_ptr<SystemGenerations> generations_;
  FollowerListener listener_;
  std::int64_t every_;
  MeasuredQueue queue_;
  std::vector<std::vector<Channel>> channels_;  // of each source
  std::vector<Input> inputs_;
  std::vector<std::optional<std::size_t>>
      pulses_;                 // of each source: the drive it is a keyphasor of
  std::vector<Shaft> shafts_;  // of each drive
  std::vector<std::unique_ptr<FollowedTrack>> systems_;  // of the scene's; nullptr: not measured
  bool began_ = false;
  std::int64_t longest_delay_ = 0;  // [ns], of all channels
  std::int64_t origin_ = 0;         // [ns], the machine's instant of step 0
  std::int64_t first_ = 0;          // [ns], of the first sample
  std::int64_t next_step_ = 0;      // to be recorded
  std::int64_t restarts_ = 0;
  std::int64_t clock_settings_ = 0;
  std::vector<double> record_;
};

}  // namespace whirl_twin
