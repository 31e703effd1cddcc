// Messages that roscpp throws away because a subscriber does not take them: a topic keeps `queue`
// writes of them for each, and then drops the oldest without a word. They are counted by what is
// still held when the next one is published.
#pragma once

#include <ros/serialized_message.h>

#include <algorithm>
#include <atomic>
#include <boost/shared_array.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace whirl_twin {

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

}  // namespace whirl_twin
