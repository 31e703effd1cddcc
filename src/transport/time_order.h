// Sorts the messages of a recording by recorded time, the order in which `rosbag play` plays them:
// merged bags, and bags written topic by topic, have their messages out of order.
//
// A first pass finds the largest delay of a message behind one with a later time. In the second
// pass a message waits until no earlier one can follow: a file in order is read directly, others
// buffer the messages within that delay.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "messages/input_error.h"
#include "transport/bag_scan.h"
#include "transport/event_scan.h"

namespace whirl_twin {

inline std::int64_t recordedTime(const RawEvent& event) {
  return event.timestamp;
}
inline std::int64_t recordedTime(const BagMessage& message) {
  return message.time;
}
inline bool isFound(EventScan::Found found) {
  return found == EventScan::Found::kEvent;
}
inline bool isFound(BagScan::Found found) {
  return found == BagScan::Found::kMessage;
}

/// The difference of corrupt times may overflow.
inline std::int64_t lag(std::int64_t newest, std::int64_t time) {
  std::int64_t behind = 0;
  return __builtin_sub_overflow(newest, time, &behind) ? std::numeric_limits<std::int64_t>::max()
                                                       : behind;
}

/// The largest delay of a selected message behind one with a later time, in the unit of their
/// times; 0: all are in order. Raw is RawEvent of an EventScan or BagMessage of a BagScan.
template <class Scan, class Raw, class Wanted>
std::int64_t largestDelay(const std::string& path, Wanted&& wanted) {
  Scan scan(path);
  Raw raw;
  std::optional<std::int64_t> newest;
  std::int64_t delay = 0;
  for (auto found = scan.next(raw); found != Scan::Found::kEnd; found = scan.next(raw)) {
    if (isFound(found) && wanted(raw)) {
      const std::int64_t time = recordedTime(raw);
      newest = std::max(newest.value_or(time), time);
      delay = std::max(delay, lag(*newest, time));
    }
  }
  return delay;
}

template <class Raw>
class TimeOrder {
 public:
  /// Called with each message and the offset [bytes] that add() received; the data are valid until
  /// it returns.
  using Take = std::function<void(const Raw&, std::uint64_t)>;

  TimeOrder(std::int64_t delay, Take take) : delay_(delay), take_(std::move(take)) {}

  /// The next message of the file. Throws InputError if more than kMaxHeld bytes would be buffered.
  void add(const Raw& raw, std::uint64_t offset) {
    const std::int64_t time = recordedTime(raw);
    out_of_order_ += newest_ && time < *newest_ ? 1 : 0;
    newest_ = std::max(newest_.value_or(time), time);
    if (delay_ == 0) {
      take_(raw, offset);
      return;
    }
    Held held{raw, {}, time, count_++, offset};
    if (raw.data != nullptr) {
      held.bytes.assign(raw.data, raw.data + raw.size);
    }
    bytes_ += sizeof(Held) + held.bytes.size();
    if (bytes_ > kMaxHeld) {
      throw InputError(
          fmt::format("sorting its messages needs more than {} MiB: sort the log by time first",
                      kMaxHeld >> 20));
    }
    waiting_.push(std::move(held));
    while (!waiting_.empty() && lag(*newest_, waiting_.top().time) >= delay_) {
      release();
    }
  }
  void finish() {
    while (!waiting_.empty()) {
      release();
    }
  }
  /// Messages that came after one with a later time.
  std::uint64_t outOfOrder() const { return out_of_order_; }

 private:
  static constexpr std::uint64_t kMaxHeld = std::uint64_t{1} << 31;

  struct Held {
    Raw raw;
    std::vector<std::uint8_t> bytes;
    std::int64_t time;
    std::uint64_t number;
    std::uint64_t offset;

    bool operator<(const Held& other) const {  // earliest on top
      return time != other.time ? time > other.time : number > other.number;
    }
  };

  void release() {
    Held first = std::move(const_cast<Held&>(waiting_.top()));
    waiting_.pop();
    bytes_ -= sizeof(Held) + first.bytes.size();
    if (first.raw.data != nullptr) {
      first.raw.data = first.bytes.data();
    }
    take_(first.raw, first.offset);
  }

  std::int64_t delay_;
  Take take_;
  std::priority_queue<Held> waiting_;
  std::optional<std::int64_t> newest_;
  std::uint64_t count_ = 0, bytes_ = 0, out_of_order_ = 0;
};

}  // namespace whirl_twin
