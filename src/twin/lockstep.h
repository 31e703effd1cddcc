// Lockstep with those who listen: who they are, how far each has come, and how far the twin may go.
//
//   a listener that has dealt with all up to a step acknowledges it; the twin goes `ahead`
//   publications beyond what the slowest of them has acknowledged, and waits there
//
// At its start the twin waits until all are there. One that acknowledges nothing for longer than
// the timeout is overdue; once it is left out, nobody waits for it until it acknowledges again, or
// is there anew.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "realtime/step_gate.h"

namespace whirl_twin {

class Lockstep {
 public:
  struct Settings {
    std::vector<std::string> who;  ///< none: no lockstep
    std::int64_t ahead = 1;        ///< publications
    std::int64_t every = 1;        ///< steps from one publication to the next
    double timeout = 5.0;          ///< [s]
  };

  /// Holds the gate, if there are any. start: the step at which the twin stands.
  Lockstep(StepGate& gate, Settings settings, std::int64_t start);

  bool on() const { return !settings_.who.empty(); }
  const Settings& settings() const { return settings_; }

  // Any thread; now [s] is of a clock that nobody sets.

  /// Whether a listener is there now, and would hear what is published next.
  void see(const std::string& who, bool there, double now);
  /// Has dealt with all up to a step. False for somebody else, and for a step that is yet to come.
  bool acknowledge(const std::string& who, std::int64_t step, double now);
  /// A step has been published; anew: it is the first one after a reset.
  void published(std::int64_t step, bool anew, double now);

  /// Those who have kept the twin waiting for longer than the timeout, and are not left out.
  std::vector<std::string> overdue(double now) const;
  void leaveOut(const std::vector<std::string>& who);
  /// Those who keep it waiting for longer than so many seconds.
  std::vector<std::string> waitsFor(double now, double patience) const;
  /// Those who are left out.
  std::vector<std::string> leftOut() const;
  /// Not all have been there yet.
  bool gathers() const;
  std::vector<std::string> missing() const;

 private:
  struct Listener {
    std::string name;
    bool known = false;  // has been there
    bool there = false;
    bool left_out = false;
    std::int64_t acknowledged = 0;
    double since = 0.0;  // [s], when the last of what it has not acknowledged was published
  };

  Listener* find(const std::string& who);
  bool holdsUp(const Listener& listener) const;
  void handOut();
  template <class Is>
  std::vector<std::string> namesOf(Is&& is) const;

  StepGate& gate_;
  const Settings settings_;
  mutable std::mutex mutex_;
  std::vector<Listener> listeners_;
  bool gathering_;
  std::int64_t published_;  // the newest; before the first, what would have been before it
  std::uint64_t run_ = 0;   // resets seen
};

}  // namespace whirl_twin
