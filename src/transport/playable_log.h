// Player of an LCM log: corrupt, invalid or repeated events are skipped, counted, and the first of
// them listed. Seeks by bisection on the file, without an index.
#pragma once

#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "messages/message.h"
#include "transport/channels.h"
#include "transport/event_scan.h"
#include "transport/lcm_event_log.h"
#include "transport/lcm_publisher.h"

namespace whirl_twin {

// Loop statistics that the player publishes for the run it plays: paused, or restarted at another
// time. A monitor then does not take the end of a log for a loss of data or a jump back for
// messages out of order.

class PlayedRun {
 public:
  PlayedRun(std::shared_ptr<lcm::LCM> lcm, const std::string& prefix, std::int64_t started)
      : lcm_(std::move(lcm), prefix), started_(started) {}

  /// Called before a message is played. Returns true if it was published here, with corrected loop
  /// statistics, in place of the one in the log.
  bool take(const Message& message);

  /// Publishes that the playback is paused or resumes.
  void hold(bool held);

  /// The next message is at another time, maybe an earlier one.
  void jump() { jumped_ = heard_; }

 private:
  void say(std::uint64_t epoch, std::int64_t later);

  LcmPublisher lcm_;
  std::int64_t started_;  ///< [ns], for a log without the start of its run
  state::LoopStatistics loop_;
  state::Instant now_;
  bool heard_ = false;           ///< a message with an instant was played
  bool has_statistics_ = false;  ///< the log has loop statistics
  bool jumped_ = false;
  std::uint64_t jumps_ = 0;
};

struct PlayedLog {
  std::uint64_t events = 0;        ///< played
  std::uint64_t not_selected = 0;  ///< on channels that are not selected
  std::uint64_t commands = 0;      ///< to the twin or the monitor, if not selected
  std::uint64_t rejected = 0;      ///< invalid, on channels of the twin
  std::uint64_t damaged = 0;       ///< places of the file that could not be read
  std::uint64_t repeated = 0;      ///< states with the step of the previous one
  std::uint64_t gaps = 0;          ///< number of gaps in the states
  /// The first kMaxNamedDefects of the last four.
  std::vector<LogDefect> defects;
};

class PlayableLog {
 public:
  using Selects = std::function<bool(const std::string& channel)>;

  /// commands: whether commands are played. Throws InputError if there is no regular file that can
  /// be read, or it is a rosbag.
  PlayableLog(const std::string& path, std::string prefix, Selects selects, bool commands);

  /// The next event to play, whose data are valid until the next call; null at the end. `message`
  /// is the decoded event on a channel of the twin.
  const RawEvent* next();
  const std::optional<Message>& message() const { return message_; }

  /// Moves to the first event that is not before `timestamp` [us], by bisection; if the stamps of
  /// the log run backward somewhere, to one such place.
  void seek(std::int64_t timestamp);

  /// Timestamps of the first event and of one at the end [us]; nothing in a log without events.
  std::optional<std::int64_t> begin() const { return begin_; }
  std::optional<std::int64_t> end() const { return end_; }
  std::uint64_t size() const { return scan_.size(); }
  std::uint64_t offset() const { return scan_.offset(); }
  const PlayedLog& played() const { return played_; }

 private:
  struct Series {
    std::int64_t step = -1;
    std::int64_t stride = 0;  ///< smallest difference so far [steps]; 0: not known
  };
  bool isToPlay(const RawEvent& event);
  bool isRepeated(const RawEvent& event, std::int64_t step);
  void name(std::uint64_t offset, std::string what);
  std::optional<RawEvent> firstFrom(std::uint64_t offset);

  EventScan scan_;
  std::string prefix_;
  Selects selects_;
  bool commands_;
  RawEvent event_;
  std::optional<Message> message_;
  std::map<std::string, Series> series_;
  std::optional<std::int64_t> begin_, end_;
  PlayedLog played_;
};

}  // namespace whirl_twin
