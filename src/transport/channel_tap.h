// Every event on some LCM channels, as it is and in the order of arrival. LCM's own queues keep at
// most 30 that nobody has looked at and lose the rest in silence; here there is no such limit,
// or the one that is asked for.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

namespace whirl_twin {

class ChannelTap {
 public:
  /// Called from receive() with the channel, when the event was received [us, wall clock] and its
  /// payload; must not throw.
  using Take = std::function<void(const std::string& channel, std::int64_t received,
                                  const std::uint8_t* data, std::size_t size)>;

  /// pattern: a regular expression; most_waiting: events that wait to be taken, the latest are
  /// lost where there are more; 0: no limit. Throws LcmNotAvailable if LCM cannot receive.
  ChannelTap(std::shared_ptr<lcm::LCM> lcm, const std::string& pattern, Take take,
             int most_waiting = 0);
  ~ChannelTap();
  ChannelTap(const ChannelTap&) = delete;
  ChannelTap& operator=(const ChannelTap&) = delete;

  /// Waits up to `timeout` for an event, then takes all that have arrived, at most `most` of them.
  void receive(std::chrono::microseconds timeout, int most = 1000);

 private:
  static void take(const lcm_recv_buf_t* buffer, const char* channel, void* tap);

  std::shared_ptr<lcm::LCM> lcm_;
  Take take_;
  lcm_subscription_t* subscription_;
};

}  // namespace whirl_twin
