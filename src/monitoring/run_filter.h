// Lets the messages of one run of a twin pass, for whoever shows or hands on what is sent: those of
// another that sends beside it are counted and left. Which run it is, and when another has taken
// its place, is ResetWatch's matter, as in the monitor.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "messages/message.h"
#include "monitoring/reset_watch.h"

namespace whirl_twin {

class RunFilter {
 public:
  /// Whether a message that came at wall_time [s, a clock that only goes forward] is of the run
  /// that is watched. Commands, measurements and what follows a machine always pass: they have
  /// clocks of their own.
  bool take(const Message& message, double wall_time);
  /// Whether one with this stamp [ns], if it has one, and time [s, simulated] is.
  bool take(std::optional<std::int64_t> stamp, double time, double wall_time);

  /// "... sends as this twin, too, beside ..."; "" with one alone.
  std::string duplicate(double wall_time) const { return resets_.duplicate(wall_time); }
  std::uint64_t ofOthers() const { return of_others_; }  ///< messages left so far

 private:
  bool takeLoop(const state::LoopStatistics& loop, double wall_time);

  ResetWatch resets_;
  std::uint64_t of_others_ = 0;
};

}  // namespace whirl_twin
