// Detects duplicate publishers: loop statistics name the publishing process once a second. Two
// processes on the same channels, a second twin or a log played beside it, would be mixed by every
// subscriber, which cannot distinguish them otherwise.
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

// Receives the datagrams of one LCM channel by multicast. The kernel filters out those of other
// channels, for which liblcm would wake up a thread each: beside a twin at full rate that costs
// nearly a third of the sending, to receive one message a second.

class ChannelListener {
 public:
  /// Whether the url is that of a multicast transport.
  static bool canListenTo(const std::string& url);

  /// Starts to receive at a url that passes canListenTo(). Throws LcmNotAvailable.
  ChannelListener(const std::string& url, const std::string& channel);
  ~ChannelListener();
  ChannelListener(const ChannelListener&) = delete;
  ChannelListener& operator=(const ChannelListener&) = delete;

  /// The payload of the next message; none if none has arrived.
  std::optional<std::vector<std::uint8_t>> next();

 private:
  std::size_t head_;  // [bytes] before the payload of a datagram
  int socket_;
  std::vector<std::uint8_t> datagram_;
};

class TwinSenders {
 public:
  /// where: the shared channels, "the LCM channels TWIN_*"; remedy: the advice to the user.
  TwinSenders(std::string where, std::string remedy);

  /// Adds statistics received at `now` [s, a monotonic clock].
  void take(const state::LoopStatistics& loop, double now);

  /// "two twins on the LCM channels TWIN_*: A, B; ...", while their messages alternate; "" for a
  /// single one, also after a replacement. A restarted process counts as a different one.
  std::string trouble(double now) const;

 private:
  using Run = std::pair<std::int64_t, std::string>;  // start of the run, sender

  std::string where_;
  std::string remedy_;
  std::map<Run, double> heard_;  // [s], last reception
  Run last_;
  std::deque<double> returns_;  // [s], times of alternation between senders
};

}  // namespace whirl_twin
