// Lockstep of the twin with its subscribers: who they are, how far each has acknowledged, and how
// far the twin may step.
//
//   A subscriber that has processed all up to a step acknowledges it; the twin runs `ahead`
//   publications beyond the last acknowledgement of the slowest one, and waits there.
//
// At its start the twin waits for all subscribers. One that acknowledges nothing for longer than
// the timeout is overdue; once excluded, it is not waited for until it acknowledges again, or is
// discovered again.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "realtime/step_barrier.h"

namespace whirl_twin {

class Lockstep {
 public:
  struct Settings {
    std::vector<std::string> who;  ///< none: no lockstep
    std::int64_t ahead = 1;        ///< publications
    std::int64_t every = 1;        ///< steps from one publication to the next
    double timeout = 5.0;          ///< [s]
  };

  /// Closes the barrier, if there are subscribers. start: the twin's current step.
  Lockstep(StepBarrier& gate, Settings settings, std::int64_t start);

  bool on() const { return !settings_.who.empty(); }
  const Settings& settings() const { return settings_; }

  // From any thread; now [s] is on a monotonic clock.

  /// Whether a subscriber is present and will receive the next publication.
  void see(const std::string& who, bool there, double now);
  /// All up to a step has been processed. False for an unknown subscriber, and for a future step.
  bool acknowledge(const std::string& who, std::int64_t step, double now);
  /// A step has been published; restarted: the first one after a reset.
  void published(std::int64_t step, bool restarted, double now);

  /// Subscribers that have blocked the twin for longer than the timeout and are not excluded.
  std::vector<std::string> overdue(double now) const;
  void leaveOut(const std::vector<std::string>& who);
  /// Subscribers that block it for longer than `patience` seconds.
  std::vector<std::string> waitsFor(double now, double patience) const;
  /// Excluded subscribers.
  std::vector<std::string> leftOut() const;
  /// Some have not been present yet.
  bool gathers() const;
  std::vector<std::string> missing() const;

 private:
  struct Listener {
    std::string name;
    bool known = false;  // has been present
    bool there = false;
    bool left_out = false;
    std::int64_t acknowledged = 0;
    double since = 0.0;  // [s], last acknowledgement, or the first publication after it
  };

  Listener* find(const std::string& who);
  bool holdsUp(const Listener& listener) const;
  void handOut();
  template <class Is>
  std::vector<std::string> namesOf(Is&& is) const;

  StepBarrier& gate_;
  const Settings settings_;
  mutable std::mutex mutex_;
  std::vector<Listener> listeners_;
  bool gathering_;
  std::int64_t published_;  // the newest; initially the one before the first
  std::uint64_t run_ = 0;   // number of resets
};

}  // namespace whirl_twin
