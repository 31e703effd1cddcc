// Summary and writer of LCM event logs, the files of lcm-logger and lcm-logplayer.
//
// A log is a sequence of events, big-endian, without a header (LCM, "Log file format"):
//   int32 sync 0xEDA1DA01, int64 event number from 0, int64 timestamp [us],
//   int32 channel length, int32 data length, channel, data
// liblcm's own reader skips garbage silently and takes corrupt bytes for the end of the file. This
// reader parses the bytes itself and reports every place that is not an event.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <string>
#include <vector>

#include "transport/channels.h"
#include "transport/lcm_converters.h"

namespace whirl_twin {

/// Summary of one channel of a log.
struct ChannelSummary {
  std::string channel;
  std::string kind;            ///< "whirl", "pendulum", ...; "other" if it is not the twin's
  std::uint64_t events = 0;    ///< valid ones
  std::uint64_t bytes = 0;     ///< of their payloads
  std::uint64_t rejected = 0;  ///< payload of the wrong type, undecodable, or invalid
  double first_time = 0.0;     ///< [s], simulated, of the first valid event; NaN for "other"
  double last_time = 0.0;      ///< [s], of the last
  // Of kinds that are a series, 0 for the others: see StepContinuity.
  std::int64_t stride = 0;
  std::uint64_t gaps = 0;
  std::uint64_t lost = 0;
  std::uint64_t repeated = 0;
  std::uint64_t late = 0;
  std::uint64_t backward = 0;
};

/// A defect of a log.
struct LogDefect {
  std::uint64_t offset = 0;  ///< [bytes] from the beginning of the file
  std::string what;
};

/// Number of defects listed one by one; further ones are only counted.
inline constexpr std::size_t kMaxNamedDefects = 20;

struct LogSummary {
  std::string path;
  std::uint64_t size = 0;                ///< [bytes]
  std::uint64_t events = 0;              ///< valid ones, of all channels
  std::int64_t first_timestamp = 0;      ///< [us], of the first event: reception or simulated time
  std::int64_t last_timestamp = 0;       ///< [us]
  std::vector<ChannelSummary> channels;  ///< by name
  std::uint64_t defect_count = 0;        ///< rejected events and corrupt places of the file
  std::vector<LogDefect> defects;        ///< the first kMaxNamedDefects of them
  std::uint64_t unreadable_bytes = 0;    ///< bytes that belong to no event
  bool truncated = false;                ///< the file ends within an event

  /// There are events, and nothing is corrupt.
  bool intact() const { return events > 0 && defect_count == 0; }
  /// No state is missing, repeated or out of order.
  bool continuous() const;
};

/// Reads the log at `path` from beginning to end; the memory grows with the number of channels, not
/// with the length. Throws InputError if there is no regular file that can be read; defects inside
/// the file are in the summary. LCM events carry no checksum: a flipped bit inside a measured
/// value, or in a timestamp that stays in order to within a second, is not detected.
/// prefix: of the channels of the recorded twin.
LogSummary readEventLog(const std::string& path, const std::string& prefix = kDefaultLcmPrefix);

/// Throws RunFailure for an error code of the system, as in errno.
[[noreturn]] void throwLogNotWritten(const std::string& path, int error);

/// Writes messages to a log whose timestamps are simulated time [us], that of the message or a
/// given one; the same messages give the same bytes.
class EventLogWriter {
 public:
  /// Creates the file, or empties it. Throws RunFailure if it cannot be written.
  explicit EventLogWriter(const std::string& path);
  EventLogWriter(const EventLogWriter&) = delete;
  EventLogWriter& operator=(const EventLogWriter&) = delete;

  /// Throws RunFailure if the event cannot be written.
  template <class State>
  void write(const State& state) {
    const std::int64_t utime = encode(state, payload_);
    writeEvent(channelOf(state), utime, payload_.data(), payload_.size());
  }
  /// The same at another time [s] than the message's: for a message that is repeated later.
  template <class State>
  void writeAt(double time, const State& state) {
    encode(state, payload_);
    writeEvent(channelOf(state), utimeOf(time), payload_.data(), payload_.size());
  }
  /// A received event, unchanged, at `utime` [us].
  void writeEvent(const std::string& channel, std::int64_t utime, const std::uint8_t* data,
                  std::size_t size);

  /// Flushes to the file system: a full disk is detected only then. Throws RunFailure.
  void finish();

 private:
  std::string path_;
  lcm::LogFile file_;
  std::vector<std::uint8_t> payload_;
};

}  // namespace whirl_twin
