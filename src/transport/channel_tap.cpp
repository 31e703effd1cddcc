#include "transport/channel_tap.h"

#include <fmt/format.h>

#include <utility>

#include "transport/lcm_connection.h"

namespace whirl_twin {

ChannelTap::ChannelTap(std::shared_ptr<lcm::LCM> lcm, const std::string& pattern, Take take,
                       int most_waiting)
    : lcm_(std::move(lcm)),
      take_(std::move(take)),
      subscription_(
          lcm_subscribe(lcm_->getUnderlyingLCM(), pattern.c_str(), &ChannelTap::take, this)) {
  if (subscription_ == nullptr) {
    throw LcmNotAvailable(fmt::format("LCM cannot receive {} (is multicast enabled?)", pattern));
  }
  lcm_subscription_set_queue_capacity(subscription_, most_waiting);
}

ChannelTap::~ChannelTap() {
  lcm_unsubscribe(lcm_->getUnderlyingLCM(), subscription_);
}

void ChannelTap::receive(std::chrono::microseconds timeout, int most) {
  handleArrived(*lcm_, timeout, most);
}

void ChannelTap::take(const lcm_recv_buf_t* buffer, const char* channel, void* tap) {
  static_cast<ChannelTap*>(tap)->take_(channel, buffer->recv_utime,
                                       static_cast<const std::uint8_t*>(buffer->data),
                                       buffer->data_size);
}

}  // namespace whirl_twin
