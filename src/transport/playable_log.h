// An LCM log, event by event, as it is to be played: whatever is damaged, or would be a lie, is
// left out, counted, and its first places named. Any instant of it is found by bisection on the
// file, so that it needs no index.
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

// What the player says of the run it plays, on the loop's channel: that it is held, and that its
// time begins anew. A monitor then takes neither the end of a log for a loss of data nor a jump
// back for messages out of order.

class PlayedRun {
 public:
  PlayedRun(std::shared_ptr<lcm::LCM> lcm, const std::string& prefix, std::int64_t started)
      : lcm_(std::move(lcm), prefix), started_(started) {}

  /// A message that is about to be played. Returns whether it has been sent here in place of the
  /// log's own, which says what is not so any more.
  bool take(const Message& message);

  /// From now on it is held, or goes on.
  void hold(bool held);

  /// What comes next is at another time, maybe an earlier one.
  void jump() { jumped_ = heard_; }

 private:
  void say(std::uint64_t epoch, std::int64_t later);

  LcmPublisher lcm_;
  std::int64_t started_;  ///< [ns], for a log that does not tell when its run was
  state::LoopStatistics loop_;
  state::Instant now_;
  bool heard_ = false;  ///< a message with an instant
  bool told_ = false;   ///< the log has said something about its loop
  bool jumped_ = false;
  std::uint64_t jumps_ = 0;
};

struct PlayedLog {
  std::uint64_t events = 0;        ///< given out
  std::uint64_t not_selected = 0;  ///< on channels that were not asked for
  std::uint64_t commands = 0;      ///< to the twin or the monitor, which were not asked for
  std::uint64_t rejected = 0;      ///< of the twin's channels, that could not be meant
  std::uint64_t damaged = 0;       ///< places of the file that could not be read
  std::uint64_t repeated = 0;      ///< states with the step of the one before
  std::uint64_t gaps = 0;          ///< places where states are missing
  /// The first kMaxNamedDefects of the last four.
  std::vector<LogDefect> defects;
};

class PlayableLog {
 public:
  using Selects = std::function<bool(const std::string& channel)>;

  /// commands: whether they are given out. Throws Refusal if there is no regular file that can be
  /// read, or it is a rosbag.
  PlayableLog(const std::string& path, std::string prefix, Selects selects, bool commands);

  /// The next event to play, whose data are valid until the next call; null at the end. `message`
  /// tells what it says where the channel is the twin's.
  const RawEvent* next();
  const std::optional<Message>& message() const { return message_; }

  /// Goes on at the first event that is not before `timestamp` [us], by bisection: of a log whose
  /// stamps run backward somewhere, at one such place.
  void seek(std::int64_t timestamp);

  /// Of the first event and one at the end [us]; nothing in a log without an event.
  std::optional<std::int64_t> begin() const { return begin_; }
  std::optional<std::int64_t> end() const { return end_; }
  std::uint64_t size() const { return scan_.size(); }
  std::uint64_t offset() const { return scan_.offset(); }
  const PlayedLog& played() const { return played_; }

 private:
  struct Series {
    std::int64_t step = -1;
    std::int64_t stride = 0;  ///< smallest so far; 0: not known
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
