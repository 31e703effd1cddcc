// The datagrams of one LCM channel, as they come by multicast. The kernel leaves out those of other
// channels, for which liblcm would wake up a thread each: beside a twin at full rate that costs
// nearly a third of what sending does, to hear one message a second.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace whirl_twin {

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

}  // namespace whirl_twin
