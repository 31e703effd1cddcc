// Who says to be the twin: its loop statistics name the process once a second. Two that send on the
// same channels, a second twin or a log that is played beside it, would be mixed by whoever
// listens, and are told apart by nothing else there.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "messages/loop_statistics.h"

namespace whirl_twin {

// The datagrams of one LCM channel, as they come by multicast. The kernel leaves out those of other
// channels, for which liblcm would wake up a thread each: beside a twin at full rate that costs
// nearly a third of what sending does, to hear one message a second.

class ChannelListener {
 public:
  /// Whether messages at this url come as such datagrams.
  static bool canListenTo(const std::string& url);

  /// From now on, at a url that it can listen to. Throws LcmNotAvailable.
  ChannelListener(const std::string& url, const std::string& channel);
  ~ChannelListener();
  ChannelListener(const ChannelListener&) = delete;
  ChannelListener& operator=(const ChannelListener&) = delete;

  /// What the next message carries; none if none has arrived.
  std::optional<std::vector<std::uint8_t>> next();

 private:
  std::size_t head_;  // [bytes] before what a datagram carries
  int socket_;
  std::vector<std::uint8_t> datagram_;
};

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
