// Which of the messages that arrive belong to the run of simulated time that is monitored. A
// network has no checksum: datagrams come late, twice or garbled, from a second twin, or from a log
// that is played beside it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "messages/message.h"

namespace whirl_twin {

/// The order in which the states of one source arrive. A source that restarts is not distinguished
/// from a late datagram by a single state: states out of order are rejected, unless no others come
/// for half a second.
class SourceClock {
 public:
  enum class Order {
    kInStep,     ///< the next state of its source
    kOutOfStep,  ///< older than the newest, the same again, or far in the future
    kFollowed,   ///< out of step, as all have been for so long that these are the states now
  };

  /// A state that holds at time [s, simulated] arrived at wall_time [s]; pace: simulated time
  /// beside wall time, as far as it is known to go faster.
  Order update(double time, double wall_time, double pace = 1.0);
  /// The next state is one from soon after `time` on: the source has reported that it starts there.
  void restartAt(double time, double wall_time);

 private:
  struct Arrival {
    double time;       ///< [s], simulated
    double wall_time;  ///< [s]
  };
  std::optional<Arrival> newest_;
  std::optional<Arrival> other_;  ///< newest of those out of step, in a row
  double other_since_ = 0.0;      ///< [s], wall time of the first of them
};

/// Which run of simulated time is monitored, and whether the twin has restarted, which it reports
/// itself: its loop statistics carry when the simulation was started, by which process, and how
/// often it has been reset since, its epoch. One message alone is not trusted: the first state of
/// the new run of time confirms it, or a second message. An epoch that is older than the present
/// one is a message that was late.
///
/// A simulation that was started again takes the place of the one before, which is silent from then
/// on. Statistics of another simulation beside those of the present one are of a duplicate
/// publisher, a second twin or a log that is played beside it, and change nothing.
class RunTracker {
 public:
  /// The loop reports which run of time this is, at wall_time [s]; true: it is a different one than
  /// before, for certain.
  bool update(const state::LoopStatistics& loop, double wall_time);
  /// Whether statistics are of the simulation that is monitored.
  bool isOfPresent(const state::LoopStatistics& loop) const;
  /// Whether a message stamped [ns] so is older than the simulation that is monitored, where that
  /// has stamps of the wall clock: of a log that is played beside it.
  bool isOfEarlier(std::int64_t stamp) const;
  /// A state with this stamp came, at wall_time [s]; returns isOfEarlier().
  bool updateStamp(std::int64_t stamp, double wall_time);
  /// Whether a state at time [s, simulated] belongs to the run of time that was announced, if one
  /// was.
  bool confirmedBy(double time, double wall_time) const;
  /// When the simulation was started and how often reset; none before it has reported so.
  std::optional<std::pair<std::int64_t, std::uint64_t>> present() const {
    if (!present_) {
      return std::nullopt;
    }
    return std::make_pair(present_->simulation.first, present_->epoch);
  }
  /// Which process runs the simulation that is monitored; "" if it has not reported so.
  std::string sender() const { return present_ ? present_->simulation.second : ""; }
  /// The announced run of time is the present one.
  void restart();

  /// Another simulation was received beside the present one, a moment ago: what comes now may be of
  /// either.
  bool hasDuplicate(double wall_time) const;
  /// Whether a state at time [s, simulated] is rather a duplicate's, by the clocks of both.
  bool isOfDuplicate(double time, double wall_time) const;
  /// Whether states may be a duplicate's as well as the present simulation's: their clocks are near
  /// one another.
  bool isAmbiguous(double wall_time) const;
  /// "duplicate publisher: ...", while two take turns; "" with one alone.
  std::string duplicate(double wall_time) const;
  /// Statistics and states of others so far.
  std::uint64_t ofOthers() const { return of_others_; }

 private:
  using Simulation = std::pair<std::int64_t, std::string>;  // when it was started, by whom
  struct Announcement {
    Simulation simulation;
    std::uint64_t epoch;
    double time;         ///< [s], simulated, when it was reported
    std::int64_t stamp;  ///< [ns], of the message
    double wall_time;    ///< [s]

    bool isSameRun(const Announcement& other) const {
      return simulation == other.simulation && epoch == other.epoch;
    }
  };
  struct Duplicate {
    double time;       ///< [s], simulated, when it was last received
    double wall_time;  ///< [s]
  };
  bool announce(const Announcement& reported);
  void updateDuplicate(const Announcement& reported);
  bool playsEarlier(double wall_time) const;

  std::optional<Announcement> present_;  ///< as first reported
  double received_at_ = 0.0;             ///< [s], wall time of its newest statistics
  double received_time_ = 0.0;           ///< [s], simulated, of the same
  std::int64_t received_stamp_ = 0;      ///< [ns], of the same
  std::optional<Announcement> next_;
  std::map<Simulation, Duplicate> duplicates_;  ///< received within kDuplicateMemory
  int returns_ = 0;                             ///< of the present one, after a duplicate
  bool duplicate_was_last_ = false;
  std::uint64_t of_others_ = 0;
  bool wall_stamps_ = false;  ///< of its states
  int earlier_ = 0;           ///< states of an earlier run, without a pause between
  double earlier_at_ = 0.0;   ///< [s], wall time of the last
};

/// Lets the messages of one run of a twin pass, for displays and bridges: those of another that
/// sends beside it are counted and left out.
class RunFilter {
 public:
  /// Whether a message that came at wall_time [s, a clock that only goes forward] is of the run
  /// that is monitored. Commands, measurements and states of estimators always pass: they have
  /// clocks of their own.
  bool take(const Message& message, double wall_time);
  /// Whether one with this stamp [ns], if it has one, and time [s, simulated] is.
  bool take(std::optional<std::int64_t> stamp, double time, double wall_time);

  /// "... sends as this twin, too, beside ..."; "" with one alone.
  std::string duplicate(double wall_time) const { return run_.duplicate(wall_time); }
  std::uint64_t ofOthers() const { return of_others_; }  ///< messages left out so far

 private:
  bool takeLoop(const state::LoopStatistics& loop, double wall_time);

  RunTracker run_;
  std::uint64_t of_others_ = 0;
};

/// The gate of the monitor: states of the monitored run, each source in its order, and whether they
/// can be evaluated at all.
class StateGate {
 public:
  enum class Result {
    kRejected,
    kNewDuplicate,  ///< the first statistics of a duplicate publisher: rejected
    kAccepted,
  };

  /// A state of a source arrived; false: it is rejected.
  bool accept(const std::string& source, const state::Instant& at, double wall_time);
  Result accept(const state::LoopStatistics& loop, double wall_time);
  /// Whether the last message has restarted time; asked once.
  bool takeRestart() { return std::exchange(restarted_, false); }

  void setWallTime(double wall_time) { wall_time_ = wall_time; }
  /// Nothing that comes can be evaluated, from now on; "": it can.
  void setUncertain(const std::string& why) { uncertain_ = why; }
  /// Why nothing can be evaluated; "": it can.
  std::string uncertainty(double wall_time) const;
  /// As far as setUncertain() goes.
  bool isCertain() const { return uncertain_.empty(); }

  bool hasReceived(const std::string& source) const { return clocks_.count(source) > 0; }
  const RunTracker& run() const { return run_; }
  double wallTime() const { return wall_time_; }  ///< [s], newest known
  double time() const { return time_; }           ///< [s], simulated, of the newest state
  std::int64_t step() const { return step_; }     ///< of the newest state

 private:
  void restart(double time, double wall_time);

  RunTracker run_;
  std::map<std::string, SourceClock> clocks_;  ///< of each source
  SourceClock loop_clock_;
  double pace_ = 1.0;       ///< [-], of simulated time, where it goes faster than the clock
  double loop_time_ = 0.0;  ///< [s], simulated, of the newest statistics
  double wall_time_ = 0.0;
  double time_ = 0.0;
  std::int64_t step_ = 0;
  bool restarted_ = false;
  std::string uncertain_;
};

}  // namespace whirl_twin
