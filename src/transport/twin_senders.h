// Who says to be the twin: its loop statistics name the process once a second. Two that send on the
// same channels, a second twin or a log that is played beside it, would be mixed by whoever
// listens, and are told apart by nothing else there.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>

#include "messages/loop_statistics.h"

namespace whirl_twin {

class TwinSenders {
 public:
  /// where: what they share, "the LCM channels TWIN_*"; remedy: what to do about it.
  TwinSenders(std::string where, std::string remedy);

  /// Statistics that were sent there, heard at `now` [s, a clock that only goes forward].
  void take(const state::LoopStatistics& loop, double now);

  /// "two twins on the LCM channels TWIN_*: A, B; ...", as long as they take turns; "" with one
  /// alone, also when another has taken its place. A process that was started again is another.
  std::string trouble(double now) const;

 private:
  using Run = std::pair<std::int64_t, std::string>;  // when it was started, who

  std::string where_;
  std::string remedy_;
  std::map<Run, double> heard_;  // [s], last
  Run last_;
  std::deque<double> returns_;  // [s], when one was heard again after another
};

}  // namespace whirl_twin
