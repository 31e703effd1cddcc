// Of states that come faster than they are wanted, the newest of each; what is news (parameters,
// alerts, the loop's statistics) is passed on at once, behind the states before it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "messages/message.h"
#include "realtime/timing_histogram.h"

namespace whirl_twin {

class NewestStates {
 public:
  /// period: from one telling of the newest to the next; 0: every message at once. now() [us] is
  /// the clock that says when messages arrived.
  NewestStates(std::chrono::microseconds period, std::function<void(const Message&)> tell,
               std::function<std::int64_t()> now);

  /// arrived [us].
  void take(const Message& message, std::int64_t arrived);
  /// Tells what is due; to be called as often as nextDue() says.
  void tellDue();
  /// How long until there is something to tell [us]; at most `longest`.
  std::chrono::microseconds nextDue(std::chrono::microseconds longest) const;

  /// States that a newer one has taken the place of.
  std::uint64_t leftOut() const { return left_out_; }
  /// [ns], from arrival to having been told.
  const TimingHistogram& latency() const { return latency_; }

 private:
  struct Kept {
    Message message;
    std::int64_t arrived;  // [us]
  };
  void tell(const Message& message, std::int64_t arrived);
  void tellAll();

  std::chrono::microseconds period_;
  std::function<void(const Message&)> tell_;
  std::function<std::int64_t()> now_;
  std::map<std::pair<const MessageKind*, std::string>, Kept> kept_;
  std::int64_t told_;  // [us], when last
  std::uint64_t left_out_ = 0;
  TimingHistogram latency_;
};

}  // namespace whirl_twin
