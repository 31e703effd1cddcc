#include "transport/lcm_receiver.h"

#include <fmt/format.h>

#include <utility>

#include "messages/message_check.h"
#include "transport/lcm_connection.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxChannels = 10'000;  // the sender chooses their names
/// Capacity of the event queue: states must not be lost during a stall of some seconds (20 s at 5
/// kHz), yet a flood that is faster than the reader must not use up the memory. StepContinuity
/// counts the displaced states by their steps.
constexpr int kMaxWaiting = 100'000;

}  // namespace

LcmReceiver::LcmReceiver(std::shared_ptr<lcm::LCM> lcm, const Kinds& kinds, Handler handler,
                         std::string prefix)
    : lcm_(std::move(lcm)), handler_(std::move(handler)), prefix_(std::move(prefix)) {
  const std::string pattern = channelPattern(kinds, prefix_);
  // LCM's C function reports a failure; the C++ wrapper does not.
  subscription_ =
      lcm_subscribe(lcm_->getUnderlyingLCM(), pattern.c_str(), &LcmReceiver::take, this);
  if (subscription_ == nullptr) {
    throw LcmNotAvailable(fmt::format("LCM cannot receive {} (is multicast enabled?)", pattern));
  }
  lcm_subscription_set_queue_capacity(subscription_, kMaxWaiting);
}

LcmReceiver::~LcmReceiver() {
  lcm_unsubscribe(lcm_->getUnderlyingLCM(), subscription_);
}

int LcmReceiver::receive(std::chrono::microseconds timeout, int most) {
  return handleArrived(*lcm_, timeout, most);
}

std::uint64_t LcmReceiver::received() const {
  std::uint64_t received = 0;
  for (const auto& [name, count] : channels_) {
    received += count.received;
  }
  return received;
}

std::uint64_t LcmReceiver::lost() const {
  std::uint64_t lost = 0;
  for (const auto& [name, count] : channels_) {
    lost += count.steps.lost();
  }
  return lost;
}

void LcmReceiver::take(const lcm_recv_buf_t* buffer, const char* channel, void* receiver) {
  auto* self = static_cast<LcmReceiver*>(receiver);
  self->arrived_ = buffer->recv_utime;
  self->take(channel, buffer->data, buffer->data_size);
}

void LcmReceiver::take(const std::string& channel, const void* data, std::size_t size) {
  // Called from C: no exception may leave it.
  try {
    const Message message = decodeEvent(channel, data, size, prefix_);
    if (channels_.size() >= kMaxChannels && channels_.count(channel) == 0) {
      throw RejectedMessage(fmt::format("more than {} channels", kMaxChannels));
    }
    auto& count = channels_[channel];
    ++count.received;
    if (const auto step = seriesStep(message)) {
      count.steps.add(*step);
    }
    handler_(message);
  } catch (const RejectedMessage& why) {
    refused_.add(channel, why.what());
  }
}

}  // namespace whirl_twin
