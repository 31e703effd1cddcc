// Sequential reader of LCM logs: events and corrupt places; see lcm_event_log.h for the format.
// After corrupt bytes it resumes at the next sync word.
#pragma once

#include <cstdint>
#include <string>

#include "transport/file_window.h"

namespace whirl_twin {

/// An event in the file.
struct RawEvent {
  std::uint64_t offset = 0;    ///< [bytes], of its sync word
  std::int64_t number = 0;     ///< sequence number, from 0
  std::int64_t timestamp = 0;  ///< [us]
  std::string channel;
  std::uint64_t size = 0;              ///< [bytes], of the payload
  const std::uint8_t* data = nullptr;  ///< the payload; null if longer than kMaxPayload
};

class EventScan {
 public:
  /// Longest payload that is read [bytes]; the twin's have a few hundred.
  static constexpr std::size_t kMaxPayload = std::size_t{1} << 20;

  enum class Found { kEvent, kDamage, kTruncation, kEnd };

  /// Throws as FileWindow does.
  explicit EventScan(const std::string& path) : file_(path) {}

  /// Advances to the next event, whose data are valid until the next call, or past a corrupt place:
  /// the bytes damageOffset() to offset() are not an event, damage() has the reason.
  Found next(RawEvent& event);

  /// Moves to the first sync word at or after `offset` [bytes], or to the end; to the beginning for
  /// 0. The bytes in between are not reported as corrupt.
  void goTo(std::uint64_t offset) { at_ = offset == 0 ? 0 : findSync(offset); }

  std::uint64_t size() const { return file_.size(); }
  /// [bytes], up to which the file has been read or skipped.
  std::uint64_t offset() const { return at_; }
  std::uint64_t damageOffset() const { return damage_offset_; }
  const std::string& damage() const { return damage_; }

 private:
  bool syncAt(std::uint64_t offset);
  std::uint64_t findSync(std::uint64_t from);
  Found skipDamage(std::string what);

  FileWindow file_;
  std::uint64_t at_ = 0;
  std::uint64_t damage_offset_ = 0;
  std::string damage_;
};

}  // namespace whirl_twin
