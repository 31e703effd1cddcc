// Messages of one topic that leave together: one write to each subscriber, and one waking of the
// thread that writes, in place of one a message.
//
// On a TCPROS connection messages follow one another, each behind its length
// (wiki.ros.org/ROS/TCPROS), so that one write may have several.
#pragma once

#include <ros/advertise_options.h>
#include <ros/publication.h>
#include <ros/serialization.h>
#include <ros/topic_manager.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "transport/queue_losses.h"

namespace whirl_twin {

/// Of one topic that is not latched, advertised as withoutHeader(). Belongs to the thread that
/// publishes.
class JoinedMessages {
 public:
  explicit JoinedMessages(std::size_t queue) : losses_(queue) {}

  /// The message leaves with the next send().
  template <class RosMessage>
  void add(const RosMessage& message) {
    static_assert(ros::message_traits::HasHeader<RosMessage>::value, "none to count in");
    const std::size_t begin = bytes_.size();
    const std::uint32_t length = ros::serialization::serializationLength(message);
    ++count_;
    bytes_.resize(begin + kLength + length);
    ros::serialization::OStream stream(bytes_.data() + begin, kLength + length);
    ros::serialization::serialize(stream, length);
    ros::serialization::serialize(stream, message);
    // `seq` comes first in a header, and roscpp leaves it alone where it knows of none.
    std::memcpy(bytes_.data() + begin + kLength, &sequence_, sizeof(sequence_));
    ++sequence_;
  }

  bool empty() const { return count_ == 0; }
  /// So many that they had better be sent.
  bool full() const { return bytes_.size() >= kMostBytes; }
  /// What has been added, to whoever subscribes to the topic; wakeSender() is to follow.
  void send(const std::string& topic);

  /// Messages that at least one subscriber has missed.
  std::uint64_t lost() const { return losses_.lost(); }

 private:
  static constexpr std::size_t kLength = 4;          // bytes, of what says how long a message is
  static constexpr std::size_t kMostBytes = 60'000;  // a write that a socket takes at once

  std::vector<std::uint8_t> bytes_;
  std::size_t count_ = 0;       // messages in them
  std::uint32_t sequence_ = 0;  // of the next
  ros::PublicationPtr publication_;
  QueueLosses losses_;
};

/// How to advertise a topic of such messages: roscpp counts once for what it takes for one.
template <class RosMessage>
ros::AdvertiseOptions withoutHeader(const std::string& topic, std::uint32_t queue) {
  ros::AdvertiseOptions options;
  options.init<RosMessage>(topic, queue);
  options.has_header = false;
  return options;
}

/// Has roscpp's thread write what was sent.
void wakeSender();

}  // namespace whirl_twin
