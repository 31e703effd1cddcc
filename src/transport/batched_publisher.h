// Publishes several messages of a topic in one write to each subscriber and one wake-up of roscpp's
// sending thread.
//
// TCPROS prefixes each message on a connection with its length (wiki.ros.org/ROS/TCPROS), so that
// one write may contain several.
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

// Counts messages that roscpp drops because a subscriber is too slow: a topic keeps `queue` writes
// for each subscriber, and then drops the oldest silently. The counter uses the number of buffers
// still referenced when the next one is published.

/// For a topic that is not latched. Used by the publishing thread only.
class QueueLosses {
 public:
  explicit QueueLosses(std::size_t queue)
      : queue_(std::max<std::size_t>(queue, 1)), messages_(queue_) {}

  /// Tracks the release of a buffer with this number of messages.
  void watch(ros::SerializedMessage& bytes, std::size_t messages) {
    // More are pending than a full queue and the current write: the slowest subscriber dropped its
    // oldest buffer for this one, which takes its place among the last `queue`.
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
  std::vector<std::size_t> messages_;  // in each of the last `queue` writes
  std::size_t next_ = 0;
  std::uint64_t lost_ = 0;
  // Shared with the buffers in flight, which may outlive this object.
  std::shared_ptr<std::atomic<std::size_t>> held_ = std::make_shared<std::atomic<std::size_t>>(0);
};

/// For a topic that is not latched, advertised as withoutHeader(). Used by the publishing thread
/// only.
class BatchedPublisher {
 public:
  explicit BatchedPublisher(std::size_t queue) : losses_(queue) {}

  /// Adds a message to the next send().
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
    // `seq` is the first field of a header; roscpp does not set it for a type without a header.
    std::memcpy(bytes_.data() + begin + kLength, &sequence_, sizeof(sequence_));
    ++sequence_;
  }

  bool empty() const { return count_ == 0; }
  /// Whether the batch is large enough to be sent.
  bool full() const { return bytes_.size() >= kMaxBytes; }
  /// Sends the batch to the subscribers of the topic; wakeSender() must follow.
  void send(const std::string& topic);

  /// Messages that at least one subscriber has missed.
  std::uint64_t lost() const { return losses_.lost(); }

 private:
  static constexpr std::size_t kLength = 4;         // bytes of the length prefix
  static constexpr std::size_t kMaxBytes = 60'000;  // a write that a socket accepts at once

  std::vector<std::uint8_t> bytes_;
  std::size_t count_ = 0;       // messages in the batch
  std::uint32_t sequence_ = 0;  // of the next message
  ros::PublicationPtr publication_;
  QueueLosses losses_;
};

/// Advertises without a header: roscpp would otherwise number each batch as one message.
template <class RosMessage>
ros::AdvertiseOptions withoutHeader(const std::string& topic, std::uint32_t queue) {
  ros::AdvertiseOptions options;
  options.init<RosMessage>(topic, queue);
  options.has_header = false;
  return options;
}

/// Signals roscpp's sending thread.
void wakeSender();

}  // namespace whirl_twin
