// The publisher thread of the simulation: everything that leaves the node at the rate of the steps.
//
// Where it is too slow for all that is due it publishes evenly what it can
// (realtime/even_thinning.h), and says so in the loop's statistics, which go on whatever the load
// is.
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

/// Of a checkpoint.
struct SavedObserver {
  std::int64_t step = 0;
  std::string image;
  std::int64_t clock_steps = 0;  ///< on the clock before the last reset
};

class RecordPublisher {
 public:
  /// What is referred to outlives it. every: steps from one publication to the next; batch: how
  /// long a record may wait to leave with others, where nobody waits for it in lockstep; clock:
  /// stamps are simulated time, which a reset does not turn back, else wall time; measure: also
  /// what the scene's sensors see.
  RecordPublisher(LiveTwin& live, const FixedRateLoop& loop, StatePublisher states,
                  LockstepListeners& lockstep, state::SceneText scene, std::int64_t every,
                  std::chrono::microseconds batch, bool clock, bool measure);
  ~RecordPublisher();

  /// Before it starts: goes on from what it knew there. Throws Refusal.
  void putBack(const Checkpoint& checkpoint, const std::string& source);
  void start();
  void join();
  /// Once it has ended: what it knows where the twin has stopped.
  SavedObserver savedAtEnd();
  // Any thread.

  bool onLcm() const { return states_.lcm().on(); }
  /// The newest report, for the diagnostics.
  state::LoopStatistics report() const;
  /// What it knew of the twin's past where a checkpoint was taken, at a step that has just been
  /// saved; nothing: its record was lost.
  std::optional<SavedObserver> savedAt(std::int64_t step);
  /// What was dropped, left out or not sent counts from zero again.
  void resetCounts() { reset_requested_.store(true); }

 private:
  void run();
  bool take(const double* record);
  bool tell(const double* record, bool anew);
  SavedObserver saved(std::int64_t step);
  void measure(bool reset);
  void measureAnew();
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
  std::int64_t clock_steps_ = 0;  // on the clock before the last reset
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
  // Of the report before.
  std::uint64_t reported_epoch_ = 0;
  double reported_time_ = 0.0;                                     // [s], simulated
  double reported_at_ = std::numeric_limits<double>::quiet_NaN();  // [s], of a clock nobody sets
  mutable std::mutex mutex_;  // report_, between this thread and the diagnostics
  state::LoopStatistics report_;
  std::mutex saved_mutex_;
  std::condition_variable saved_anew_;
  std::optional<SavedObserver> newest_saved_;  // between this thread and who saves
  std::atomic<bool> reset_requested_{false};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace whirl_twin
