// Messages of one topic that leave together: one write to each subscriber, and one waking of the
// thread that writes, in place of one a message.
//
// On a TCPROS connection messages follow one another, each behind its length
// (wiki.ros.org/ROS/TCPROS), so that one write may have several.
#pragma once

#include <ros/publication.h>
#include <ros/serialization.h>
#include <ros/topic_manager.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "transport/queue_losses.h"

namespace whirl_twin {

/// Of one topic that is not latched, whose messages have a header. Belongs to the thread that
/// publishes.
class JoinedMessages {
 public:
  explicit JoinedMessages(std::size_t queue) : losses_(queue) {}

  /// The message leaves with the next send().
  template <class RosMessage>
  void add(const RosMessage& message) {
    const std::size_t begin = bytes_.size();
    const std::uint32_t length = ros::serialization::serializationLength(message);
    begins_.push_back(begin);
    bytes_.resize(begin + kLength + length);
    ros::serialization::OStream stream(bytes_.data() + begin, kLength + length);
    ros::serialization::serialize(stream, length);
    ros::serialization::serialize(stream, message);
  }

  bool empty() const { return begins_.empty(); }
  /// So many that they had better be sent.
  bool full() const { return bytes_.size() >= kMostBytes; }
  /// What has been added, to whoever subscribes to the topic.
  void send(const std::string& topic);

  /// Messages that at least one subscriber has missed.
  std::uint64_t lost() const { return losses_.lost(); }

 private:
  static constexpr std::size_t kLength = 4;          // bytes, of what says how long a message is
  static constexpr std::size_t kMostBytes = 60'000;  // a write that a socket takes at once

  std::vector<std::uint8_t> bytes_;
  std::vector<std::size_t> begins_;  // of each message
  ros::PublicationPtr publication_;
  QueueLosses losses_;
};

}  // namespace whirl_twin
