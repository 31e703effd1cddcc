// Which run of simulated time is watched, and whether the twin has begun anew, which it says
// itself: its loop statistics carry when the simulation was started, by which process, and how
// often it has been reset since, its epoch. One message alone is not believed, for a network has no
// checksum: the first state of the new run of time confirms it, or a second message. An epoch that
// is older than the present one is a message that was late.
//
// A simulation that was started again takes the place of the one before, which is silent from then
// on. Statistics of another simulation beside those of the present one are of a second twin, or of
// a log that is played beside it, and change nothing.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "messages/loop_statistics.h"

namespace whirl_twin {

class ResetWatch {
 public:
  /// The loop says which run of time this is, at wall_time [s]; true: it is another than before,
  /// for certain.
  bool take(const state::LoopStatistics& loop, double wall_time);
  /// Whether statistics are of the simulation that is watched.
  bool isOfPresent(const state::LoopStatistics& loop) const;
  /// Whether a message stamped [ns] so is older than the simulation that is watched, where that
  /// has stamps of the wall clock: of a log that is played beside it.
  bool isOfEarlier(std::int64_t stamp) const;
  /// A state with this stamp came, at wall_time [s]; returns isOfEarlier().
  bool takeStamp(std::int64_t stamp, double wall_time);
  /// Whether a state at time [s, simulated] belongs to the run of time that was announced, if one
  /// was.
  bool confirmedBy(double time, double wall_time) const;
  /// When the simulation was started and how often reset; none before it has said so.
  std::optional<std::pair<std::int64_t, std::uint64_t>> present() const {
    if (!present_) {
      return std::nullopt;
    }
    return std::make_pair(present_->simulation.first, present_->epoch);
  }
  /// Which process runs the simulation that is watched; "" if it has not said so.
  std::string sender() const { return present_ ? present_->simulation.second : ""; }
  /// The announced run of time is the present one.
  void begin();

  /// Another simulation has been heard beside the present one, a moment ago: what comes now may be
  /// of either.
  bool hasRival(double wall_time) const;
  /// Whether a state at time [s, simulated] is rather a rival's, by the clocks of both.
  bool isOfRival(double time, double wall_time) const;
  /// Whether states of time [s, simulated] may be a rival's as well as the present simulation's:
  /// their clocks are near one another.
  bool isAmbiguous(double wall_time) const;
  /// "simulation_node on ... sends, too", while two take turns; "" with one alone.
  std::string duplicate(double wall_time) const;
  /// Statistics and states of others so far.
  std::uint64_t ofOthers() const { return of_others_; }

 private:
  using Simulation = std::pair<std::int64_t, std::string>;  // when it was started, by whom
  struct Announcement {
    Simulation simulation;
    std::uint64_t epoch;
    double time;         ///< [s], simulated, when it was said
    std::int64_t stamp;  ///< [ns], of the message
    double wall_time;    ///< [s]

    bool isSameRun(const Announcement& other) const {
      return simulation == other.simulation && epoch == other.epoch;
    }
  };
  struct Rival {
    double time;       ///< [s], simulated, when it was last heard
    double wall_time;  ///< [s]
  };
  bool announce(const Announcement& said);
  void takeOfRival(const Announcement& said);
  bool playsEarlier(double wall_time) const;

  std::optional<Announcement> present_;  ///< as first said
  double heard_at_ = 0.0;                ///< [s], wall time of its newest statistics
  double heard_time_ = 0.0;              ///< [s], simulated, of the same
  std::int64_t heard_stamp_ = 0;         ///< [ns], of the same
  std::optional<Announcement> next_;
  std::map<Simulation, Rival> rivals_;  ///< heard within kMemory
  int returns_ = 0;                     ///< of the present one, after a rival
  bool rival_was_last_ = false;
  std::uint64_t of_others_ = 0;
  bool wall_stamps_ = false;  ///< of its states
  int earlier_ = 0;           ///< states of an earlier run, without a pause between
  double earlier_at_ = 0.0;   ///< [s], wall time of the last
};

}  // namespace whirl_twin
