#include "transport/batched_publisher.h"

#include <ros/poll_manager.h>

#include <algorithm>

namespace whirl_twin {

void BatchedPublisher::send(const std::string& topic) {
  if (!publication_ || publication_->isDropped()) {
    publication_ = ros::TopicManager::instance()->lookupPublication(topic);
  }
  if (publication_ && count_ > 0) {
    const boost::shared_array<std::uint8_t> copy(new std::uint8_t[bytes_.size()]);
    std::copy(bytes_.begin(), bytes_.end(), copy.get());
    ros::SerializedMessage joined(copy, bytes_.size());
    losses_.watch(joined, count_);
    publication_->publish(joined);
  }
  bytes_.clear();
  count_ = 0;
}

void wakeSender() {
  ros::PollManager::instance()->getPollSet().signal();
}

}  // namespace whirl_twin
