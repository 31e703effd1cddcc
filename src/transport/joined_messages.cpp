#include "transport/joined_messages.h"

#include <algorithm>
#include <cstring>

namespace whirl_twin {

void JoinedMessages::send(const std::string& topic) {
  if (!publication_ || publication_->isDropped()) {
    publication_ = ros::TopicManager::instance()->lookupPublication(topic);
  }
  if (publication_ && !begins_.empty()) {
    // roscpp counts once for what it takes for one message, in the header of the first.
    std::uint32_t count = publication_->getSequence();
    for (const std::size_t begin : begins_) {
      std::memcpy(bytes_.data() + begin + kLength, &count, sizeof(count));
      ++count;
    }
    const boost::shared_array<std::uint8_t> copy(new std::uint8_t[bytes_.size()]);
    std::copy(bytes_.begin(), bytes_.end(), copy.get());
    ros::SerializedMessage joined(copy, bytes_.size());
    losses_.watch(joined, begins_.size());
    publication_->enqueueMessage(joined);
    for (std::size_t i = 1; i < begins_.size(); ++i) {
      publication_->incrementSequence();
    }
  }
  bytes_.clear();
  begins_.clear();
}

}  // namespace whirl_twin
