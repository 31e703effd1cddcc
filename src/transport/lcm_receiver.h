// LCM receiver: every event of the selected kinds, in the order of arrival. Only a queue of more
// than 100,000 events drops any; an event that does not decode is rejected and counted.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <memory>
#include <string>

#include "transport/lcm_decode.h"
#include "transport/refused_payloads.h"
#include "transport/step_continuity.h"

namespace whirl_twin {

/// Statistics of one channel.
struct ChannelCount {
  std::uint64_t received = 0;
  StepContinuity steps;  ///< of the channels of a series, see seriesStep()
};

class LcmReceiver {
 public:
  using Handler = std::function<void(const Message&)>;

  /// Subscribes to the channels of these kinds. `handler` is called from receive(), and must not
  /// throw. Throws LcmNotAvailable if LCM cannot receive.
  LcmReceiver(std::shared_ptr<lcm::LCM> lcm, const Kinds& kinds, Handler handler,
              std::string prefix = kDefaultLcmPrefix);
  ~LcmReceiver();
  LcmReceiver(const LcmReceiver&) = delete;
  LcmReceiver& operator=(const LcmReceiver&) = delete;

  /// Waits up to `timeout` for an event, then handles the queued events, at most `most` of them.
  /// Returns their number.
  int receive(std::chrono::microseconds timeout, int most = 1000);

  const std::map<std::string, ChannelCount>& channels() const { return channels_; }
  /// Arrival of the event that is being handled [us, wall clock].
  std::int64_t arrived() const { return arrived_; }
  /// Over all channels: states accepted, states missing by their steps, events rejected.
  std::uint64_t received() const;
  std::uint64_t lost() const;
  std::uint64_t rejected() const { return refused_.total(); }
  const RefusedPayloads& refused() const { return refused_; }

 private:
  static void take(const lcm_recv_buf_t* buffer, const char* channel, void* receiver);
  void take(const std::string& channel, const void* data, std::size_t size);

  std::shared_ptr<lcm::LCM> lcm_;
  Handler handler_;
  std::string prefix_;
  lcm_subscription_t* subscription_ = nullptr;
  std::map<std::string, ChannelCount> channels_;
  std::int64_t arrived_ = 0;  // [us], wall clock
  RefusedPayloads refused_;
};

}  // namespace whirl_twin
