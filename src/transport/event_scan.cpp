#include "transport/event_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace whirl_twin {
namespace {

constexpr std::array<std::uint8_t, 4> kSync{0xed, 0xa1, 0xda, 0x01};
constexpr std::uint64_t kEventHeaderSize = 28;
/// Longest channel name of LCM.
constexpr std::int32_t kMaxChannel = 63;
/// Length of one search step [bytes]; short against the window, so that it seldom has to move.
constexpr std::uint64_t kEventSearchLength = 1 << 16;

std::uint64_t bigEndian(const std::uint8_t* bytes, int count) {
  std::uint64_t number = 0;
  for (int i = 0; i < count; ++i) {
    number = number << 8 | bytes[i];
  }
  return number;
}

}  // namespace

EventScan::Found EventScan::next(RawEvent& event) {
  const std::uint64_t left = file_.size() - at_;
  if (left == 0) {
    return Found::kEnd;
  }
  if (!syncAt(at_)) {
    return skipDamage("expected the sync word of an event");
  }
  if (left < kEventHeaderSize) {
    return skipDamage("the file ends within the header of an event");
  }
  const std::uint8_t* header = file_.at(at_, kEventHeaderSize);
  const auto channel_length = static_cast<std::int32_t>(bigEndian(header + 20, 4));
  const auto data_length = static_cast<std::int32_t>(bigEndian(header + 24, 4));
  if (channel_length < 1 || channel_length > kMaxChannel) {
    return skipDamage(fmt::format("channel name: expected 1 to {} characters, found {}",
                                  kMaxChannel, channel_length));
  }
  if (data_length < 0) {
    return skipDamage(fmt::format("payload: expected at least 0 bytes, found {}", data_length));
  }
  event.offset = at_;
  event.number = static_cast<std::int64_t>(bigEndian(header + 4, 8));
  event.timestamp = static_cast<std::int64_t>(bigEndian(header + 12, 8));
  event.size = static_cast<std::uint64_t>(data_length);
  const std::uint64_t payload = kEventHeaderSize + static_cast<std::uint64_t>(channel_length);
  const std::uint64_t length = payload + event.size;
  if (length > left) {
    return skipDamage(
        fmt::format("an event of {} bytes, but the file ends after {}", length, left));
  }
  if (length < left && !syncAt(at_ + length)) {
    return skipDamage(fmt::format("an event of {} bytes without a following event", length));
  }
  const bool readable = event.size <= kMaxPayload;
  const std::uint8_t* bytes = file_.at(at_, readable ? length : payload);
  event.channel.assign(bytes + kEventHeaderSize, bytes + payload);
  event.data = readable ? bytes + payload : nullptr;
  at_ += length;
  return Found::kEvent;
}

/// Whether the sync word, or its beginning at the end of the file, is at this offset.
bool EventScan::syncAt(std::uint64_t offset) {
  const std::size_t length = std::min<std::uint64_t>(kSync.size(), file_.size() - offset);
  const std::uint8_t* bytes = file_.at(offset, length);
  return std::equal(bytes, bytes + length, kSync.begin());
}

/// Offset of the next sync word, or the end of the file.
std::uint64_t EventScan::findSync(std::uint64_t from) {
  while (from + kSync.size() <= file_.size()) {
    const std::size_t length = std::min<std::uint64_t>(kEventSearchLength, file_.size() - from);
    const std::uint8_t* bytes = file_.at(from, length);
    const std::uint8_t* found = std::search(bytes, bytes + length, kSync.begin(), kSync.end());
    if (found != bytes + length) {
      return from + static_cast<std::uint64_t>(found - bytes);
    }
    from += length - (kSync.size() - 1);  // a sync word may cross the boundary
  }
  return file_.size();
}

EventScan::Found EventScan::skipDamage(std::string what) {
  const bool began_as_event = syncAt(at_);
  damage_offset_ = at_;
  damage_ = std::move(what);
  at_ = findSync(at_ + 1);
  return began_as_event && at_ == file_.size() ? Found::kTruncation : Found::kDamage;
}

}  // namespace whirl_twin
