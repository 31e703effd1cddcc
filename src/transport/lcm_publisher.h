// LCM publisher, each message on its channel. For a publisher thread: allocates and writes to a
// socket.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>
#include <vector>

#include "transport/channels.h"
#include "transport/lcm_converters.h"

namespace whirl_twin {

class LcmPublisher {
 public:
  /// Opens LCM at `url`; an empty url disables it. If LCM cannot be opened (no multicast route, a
  /// malformed url) the publisher is disabled and warning() has the reason.
  explicit LcmPublisher(const std::string& url, std::string prefix = kDefaultLcmPrefix);

  /// Publishes on an open LCM, e.g. "memq://" in a test.
  explicit LcmPublisher(std::shared_ptr<lcm::LCM> lcm, std::string prefix = kDefaultLcmPrefix);

  bool on() const { return lcm_ != nullptr; }
  const std::string& prefix() const { return prefix_; }

  /// Why LCM is disabled although a url was given; otherwise "".
  const std::string& warning() const { return warning_; }

  /// Does nothing while disabled.
  template <class State>
  void publish(const State& state) {
    if (lcm_) {
      encode(state, payload_);
      send(channelOf(state, prefix_));
    }
  }

  /// Messages given to LCM, and those that LCM failed to send.
  std::uint64_t sent() const { return sent_; }
  std::uint64_t failed() const { return failed_; }

 private:
  void send(const std::string& channel);

  std::shared_ptr<lcm::LCM> lcm_;
  std::string prefix_;
  std::string warning_;
  std::vector<std::uint8_t> payload_;
  std::uint64_t sent_ = 0;
  std::uint64_t failed_ = 0;
};

}  // namespace whirl_twin
