// Messages of one topic that leave together: one write to each subscriber, and one waking of the
// thread that writes, in place of one a message.
//
// On a TCPROS connection messages follow one another, each behind its length
// (wiki.ros.org/ROS/TCPROS), so that one write may have several.
#pragma once

#include <ros/advertise_options.h>
#include <ros/publication.h>
#include <ros/serialization.h>
#include <ros/serialized_message.h>
#include <ros/topic_manager.h>

#include <algorithm>
#include <atomic>
#include <boost/shared_array.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace whirl_twin {

// Messages that roscpp throws away because a subscriber does not take them: a topic keeps `queue`
// writes of them for each, and then drops the oldest without a word. They are counted by what is
// still held when the next one is published.

/// Of one topic that is not latched. Belongs to the thread that publishes.
class QueueLosses {
 public:
  explicit QueueLosses(std::size_t queue)
      : queue_(std::max<std::size_t>(queue, 1)), messages_(queue_) {}

  /// Has bytes of so many messages tell when nobody needs them any more.
  void watch(ros::SerializedMessage& bytes, std::size_t messages) {
    // A queue that is full, and the write that is under way: the slowest subscriber's oldest goes
    // for this one, which takes its place among the last `queue`.
    std::size_t& place = messages_[next_];
    next_ = next_ + 1 < queue_ ? next_ + 1 : 0;
    lost_ += held_->fetch_add(1) > queue_ ? place : 0;
    place = messages;
    const auto done = [held = held_, kept = bytes.buf](std::uint8_t*) { held->fetch_sub(1); };
    bytes.buf = boost::shared_array<std::uint8_t>(bytes.buf.get(), done);
  }

  /// Messages that at least one subscriber has missed.
  std::uint64_t lost() const { return lost_; }

 private:
  std::size_t queue_;
  std::vector<std::size_t> messages_;  // of each of the last `queue` writes
  std::size_t next_ = 0;
  std::uint64_t lost_ = 0;
  // Outlives this, as messages do that are on their way.
  std::shared_ptr<std::atomic<std::size_t>> held_ = std::make_shared<std::atomic<std::size_t>>(0);
};

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
