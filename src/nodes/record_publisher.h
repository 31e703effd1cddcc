// Publisher thread of the simulation: everything that the node publishes at the rate of the steps.
//
// If it is too slow for all publications due, it publishes a uniformly thinned part of them
// (realtime/even_thinning.h), and reports this in the loop statistics, which are published at any
// load.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "messages/loop_statistics.h"
#include "messages/scene_text.h"
#include "nodes/lockstep_listeners.h"
#include "nodes/state_publisher.h"
#include "realtime/even_thinning.h"
#include "realtime/fixed_rate_loop.h"
#include "twin/checkpoint.h"
#include "twin/live_twin.h"
#include "twin/measurements.h"
#include "twin/observer.h"
#include "twin/order_observer.h"

namespace whirl_twin {

/// Part of a checkpoint.
struct SavedObserver {
  std::int64_t step = 0;
  std::string image;
  std::int64_t clock_steps = 0;  ///< on /clock before the last reset
};

class RecordPublisher {
 public:
  /// The referenced objects must outlive it. every: steps from one publication to the next; batch:
  /// how long a record may wait for a joint write, without lockstep; clock: stamps are simulated
  /// time, which continues across a reset, else wall time; measure: publish the measurements of the
  /// scene's sensors.
  RecordPublisher(LiveTwin& live, const FixedRateLoop& loop, StatePublisher states,
                  LockstepListeners& lockstep, state::SceneText scene, std::int64_t every,
                  std::chrono::microseconds batch, bool clock, bool measure);
  ~RecordPublisher();

  /// Before start(): restores the publisher's state from a checkpoint. Throws InputError.
  void restore(const Checkpoint& checkpoint, const std::string& source);
  void start();
  void join();
  /// After join(): the publisher's state at the last step.
  SavedObserver savedAtEnd();
  // Any thread may call the following.

  bool onLcm() const { return states_.lcm().on(); }
  /// The newest report, for the diagnostics.
  state::LoopStatistics report() const;
  /// The publisher's state at the step of a checkpoint that was just taken; nothing: its record was
  /// lost.
  std::optional<SavedObserver> savedAt(std::int64_t step);
  /// Resets the counts of steps dropped and skipped, and of messages not sent.
  void resetCounts() { reset_requested_.store(true); }

 private:
  void run();
  bool take(const double* record);
  bool tell(const double* record, bool restarted);
  SavedObserver saved(std::int64_t step);
  void measure(bool reset);
  void remeasure();
  void publishReport();
  double achievedFactor(const state::LoopStatistics& report);
  void followWallClock();
  void stamp(const double* record);
  std::uint64_t dropped() const { return live_.dropped() + left_out_ - dropped_before_; }
  std::uint64_t lcmFailed() const { return states_.lcm().failed() - lcm_failed_before_; }
  std::uint64_t rosLost() const { return states_.ros().lost() - ros_lost_before_; }
  void forgetCounts();

  LiveTwin& live_;
  const FixedRateLoop& loop_;
  Observer observer_;
  OrderObserver orders_;
  StatePublisher states_;
  LockstepListeners& lockstep_;
  state::SceneText scene_;
  std::int64_t newest_step_;  // of the records
  bool clock_;
  std::int64_t clock_steps_ = 0;  // on /clock before the last reset
  std::int64_t every_;            // steps
  std::chrono::microseconds batch_;
  EvenThinning thinning_;
  std::int64_t started_;     // [ns], wall clock
  std::int64_t clock_zero_;  // [ns], wall clock at zero of CLOCK_MONOTONIC
  std::vector<bool> stopped_;
  std::vector<bool> inaccurate_;
  bool measuring_;
  std::optional<Measurements> measurements_;
  std::uint64_t left_out_ = 0;  // steps that were due
  std::uint64_t dropped_before_ = 0;
  std::uint64_t lcm_failed_before_ = 0;
  std::uint64_t lcm_failed_told_ = 0;
  std::uint64_t ros_lost_before_ = 0;
  std::uint64_t ros_lost_told_ = 0;
  // Of the previous report.
  std::uint64_t reported_epoch_ = 0;
  double reported_time_ = 0.0;                                     // [s], simulated
  double reported_at_ = std::numeric_limits<double>::quiet_NaN();  // [s], CLOCK_MONOTONIC
  mutable std::mutex mutex_;  // guards report_, which the diagnostics read
  state::LoopStatistics report_;
  std::mutex saved_mutex_;
  std::condition_variable saved_anew_;
  std::optional<SavedObserver> newest_saved_;  // read by the thread that saves
  std::atomic<bool> reset_requested_{false};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace whirl_twin
