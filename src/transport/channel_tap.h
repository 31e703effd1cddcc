// Subscription to LCM channels that keeps every event, unchanged and in the order of arrival. LCM's
// own queues hold at most 30 unhandled events and drop further ones silently; here the queue is
// unlimited, or has a given limit.
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
  /// Called from receive() with the channel, the time of reception [us, wall clock] and the
  /// payload; must not throw.
  using Take = std::function<void(const std::string& channel, std::int64_t received,
                                  const std::uint8_t* data, std::size_t size)>;

  /// pattern: a regular expression; most_waiting: length of the queue, further events are dropped;
  /// 0: no limit. Throws LcmNotAvailable if LCM cannot receive.
  ChannelTap(std::shared_ptr<lcm::LCM> lcm, const std::string& pattern, Take take,
             int most_waiting = 0);
  ~ChannelTap();
  ChannelTap(const ChannelTap&) = delete;
  ChannelTap& operator=(const ChannelTap&) = delete;

  /// Waits up to `timeout` for an event, then handles the queued events, at most `most` of them.
  void receive(std::chrono::microseconds timeout, int most = 1000);

 private:
  static void take(const lcm_recv_buf_t* buffer, const char* channel, void* tap);

  std::shared_ptr<lcm::LCM> lcm_;
  Take take_;
  lcm_subscription_t* subscription_;
};

}  // namespace whirl_twin
