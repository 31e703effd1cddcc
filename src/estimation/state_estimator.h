// State estimator of a running machine: takes measurements and returns records of a twin, as if it
// had been stepped, together with the estimated parameters.
//
// Instants are on the machine's clock. The first sample is the scene's start; the twin's steps
// count from there along the machine's clock. A system keeps the scene's state until its first
// sample, and, on a shaft with a keyphasor but no pulse yet, for up to a second; after that, and
// whenever pulses cease, it is estimated from its probes alone. If samples cease for a second, or
// the machine's clock is set, the motion is re-initialized and learned parameters are kept; the
// twin's time continues.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "estimation/estimator_shaft.h"
#include "estimation/estimator_sources.h"
#include "estimation/estimator_track.h"
#include "estimation/follow_settings.h"
#include "estimation/measured_queue.h"
#include "messages/follow_state.h"
#include "messages/measurement.h"
#include "twin/system_generations.h"
#include "twin/twin.h"

namespace whirl_twin {

/// Receives the results, in the order of the twin's steps.
struct EstimatorListener {
  std::function<void(const double* record)> record;
  std::function<void(const state::FollowState&)> follow;
};

class StateEstimator {
 public:
  /// The sensors of the twin's scene define what is measured; the twin is not stepped. every: steps
  /// between records. Throws InputError for a scene without a measured system.
  StateEstimator(const Twin& twin, std::shared_ptr<SystemGenerations> generations,
                 const FollowSettings& settings, std::int64_t every, EstimatorListener listener);
  ~StateEstimator();

  /// The next message; messages of sources that are not in the scene are ignored.
  void take(const state::Measurement& message);
  /// No more messages will come.
  void finish();

  /// Of a measured system; nullptr: it is not measured.
  const ExtendedKalmanFilter* filter(std::size_t system) const;
  /// For all numbers its filter has learned: robust standard deviations over those of its
  /// covariance.
  const Eigen::VectorXd& deviationFactors(std::size_t system) const;
  /// [ns], on the machine's clock.
  std::int64_t machineInstant(std::int64_t step) const;
  /// Root mean square of the residuals of each channel since its motion was found; NaN: none.
  std::vector<double> residualRms(std::size_t system) const;
  /// Number of re-initializations of the motion.
  std::int64_t restarts() const { return restarts_; }
  /// Number of times the machine's clock was set.
  std::int64_t clockSettings() const { return clock_settings_; }

 private:
  struct Channel {
    std::size_t system = 0;
    std::size_t place = 0;   // in its filter
    std::int64_t delay = 0;  // [ns], of the sensor
    std::optional<InputFollowing> input = std::nullopt;
  };
  /// The channel that measures an input.
  struct Input {
    std::size_t system, source, channel;
  };
  struct Shaft {
    EstimatorShaft motion;
    std::optional<std::size_t> source;  // of its pulses
  };

  void addSensors(const FollowSettings& settings);
  void process();
  void takePulse(std::size_t drive, const MeasuredSample& pulse);
  void takeSample(const MeasuredSample& sample);
  void takeInput(const Channel& channel, const MeasuredSample& sample);
  void takeNextInputs(EstimatorTrack& system);
  void stepUntil(std::int64_t instant);
  void writeRecord(std::int64_t step);
  /// Energy [J] of a system in the current record, v dL/dv - L.
  double heldEnergy(const EstimatorTrack& followed) const;
  void tellState(EstimatorTrack& system);
  void begin(std::int64_t instant);
  ShaftEstimate shaftAt(std::size_t drive, std::int64_t instant);
  ShaftEstimate shaftOf(const EstimatorTrack& system, std::int64_t instant);

  const Twin& twin_;
  std::shared_ptr<SystemGenerations> generations_;
  EstimatorListener listener_;
  std::int64_t every_;
  MeasuredQueue queue_;
  std::vector<std::vector<Channel>> channels_;  // of each source
  std::vector<Input> inputs_;
  std::vector<std::optional<std::size_t>> pulses_;        // of each source: drive of its keyphasor
  std::vector<Shaft> shafts_;                             // of each drive
  std::vector<std::unique_ptr<EstimatorTrack>> systems_;  // of the scene's; nullptr: not measured
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
