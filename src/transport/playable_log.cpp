#include "transport/playable_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "messages/input_error.h"
#include "messages/message_check.h"
#include "messages/names.h"
#include "transport/bag_scan.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {

bool PlayedRun::take(const Message& message) {
  const auto* const loop = std::get_if<state::LoopStatistics>(&message);
  if (loop != nullptr) {
    loop_ = *loop;
    has_statistics_ = true;
  }
  if (seriesStep(message)) {
    std::visit(
        [this](const auto& state) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(state)>, state::Alert>) {
            now_ = state.at;
          }
        },
        message);
    heard_ = true;
    if (jumped_) {
      jumped_ = false;
      // Announced twice, as subscribers require; a log without loop statistics needs one before
      // them, of the run that ends.
      if (!has_statistics_) {
        say(jumps_, 0);
      }
      ++jumps_;
      say(jumps_, 1);
      say(jumps_, 2);
    }
  }
  if (loop != nullptr && jumps_ > 0) {
    now_ = loop->at;
    say(jumps_, 0);
    return true;
  }
  return false;
}

void PlayedRun::hold(bool held) {
  loop_.paused = held;
  if (heard_) {
    say(jumps_, 0);
  }
}

/// later: offset of the stamp [ns], so that successive announcements differ.
void PlayedRun::say(std::uint64_t epoch, std::int64_t later) {
  state::LoopStatistics said = loop_;
  said.at = now_;
  said.at.stamp += later;
  said.started = has_statistics_ ? loop_.started : started_;
  said.epoch += epoch;
  lcm_.publish(said);
}

namespace {

/// Bisection ends at this length, and the remainder is scanned [bytes].
constexpr std::uint64_t kNear = 1 << 16;

}  // namespace

PlayableLog::PlayableLog(const std::string& path, std::string prefix, Selects selects,
                         bool commands)
    : scan_(path), prefix_(std::move(prefix)), selects_(std::move(selects)), commands_(commands) {
  if (BagScan::isBag(path)) {
    throw InputError(path + ": must be an LCM log, found a rosbag; use `rosbag play`");
  }
  if (const auto first = firstFrom(0)) {
    begin_ = end_ = first->timestamp;
    for (std::uint64_t back = kNear; end_ == begin_ && back < 2 * scan_.size(); back *= 4) {
      for (auto last = firstFrom(scan_.size() - std::min(back, scan_.size())); last;
           last = firstFrom(scan_.offset())) {
        end_ = last->timestamp;
      }
    }
  }
  scan_.goTo(0);
}

/// The first valid event at or after `offset`; the scan is then positioned behind it.
std::optional<RawEvent> PlayableLog::firstFrom(std::uint64_t offset) {
  scan_.goTo(offset);
  for (auto found = scan_.next(event_); found != EventScan::Found::kEnd;
       found = scan_.next(event_)) {
    if (found == EventScan::Found::kEvent) {
      return event_;
    }
  }
  return std::nullopt;
}

void PlayableLog::seek(std::int64_t timestamp) {
  std::uint64_t low = 0, high = scan_.size();
  while (high - low > kNear) {
    const std::uint64_t middle = low + (high - low) / 2;
    const auto event = firstFrom(middle);
    if (event && event->offset < high && event->timestamp < timestamp) {
      low = event->offset;
    } else {
      high = middle;
    }
  }
  std::uint64_t at = low;
  for (auto event = firstFrom(at); event && event->timestamp < timestamp; event = firstFrom(at)) {
    at = scan_.offset();
  }
  scan_.goTo(at);
  series_.clear();
}

const RawEvent* PlayableLog::next() {
  for (auto found = scan_.next(event_); found != EventScan::Found::kEnd;
       found = scan_.next(event_)) {
    if (found != EventScan::Found::kEvent) {
      ++played_.damaged;
      name(scan_.damageOffset(), scan_.damage());
    } else if (isToPlay(event_)) {
      ++played_.events;
      return &event_;
    }
  }
  return nullptr;
}

bool PlayableLog::isToPlay(const RawEvent& event) {
  message_.reset();
  if (!selects_(event.channel)) {
    ++played_.not_selected;
    return false;
  }
  const auto channel = parseChannel(event.channel, prefix_);
  const bool fits = event.data != nullptr;
  try {
    if (!fits) {
      throw RejectedMessage(fmt::format("payload: expected at most {} bytes, found {}",
                                        EventScan::kMaxPayload, event.size));
    }
    const bool commands = channel ? channel->kind->has(MessageKind::kCommand)
                                  : event.channel == prefix_ + kCommandsChannel;
    if (commands && !commands_) {
      ++played_.commands;
      return false;
    }
    if (!channel) {
      return true;  // not a channel of the twin
    }
    message_ = decodeEvent(event.channel, event.data, event.size, prefix_);
  } catch (const RejectedMessage& why) {
    ++played_.rejected;
    name(event.offset, printable(event.channel) + ": " + why.what());
    return false;
  }
  const auto step = seriesStep(*message_);
  return !step || !isRepeated(event, *step);
}

/// Whether the state repeats the step of the previous one; records missing states as a defect.
bool PlayableLog::isRepeated(const RawEvent& event, std::int64_t step) {
  Series& series = series_[event.channel];
  const std::int64_t passed = step - series.step;
  const bool first = series.step < 0;
  series.step = step;
  if (first || passed < 0) {
    return false;  // first state, or a restart
  }
  if (passed == 0) {
    ++played_.repeated;
    name(event.offset, fmt::format("{}: step {} repeated", event.channel, step));
    return true;
  }
  if (series.stride > 0 && passed >= 2 * series.stride) {
    ++played_.gaps;
    name(event.offset, fmt::format("{}: steps {} to {} are missing", event.channel,
                                   step - passed + series.stride, step - series.stride));
  }
  series.stride = series.stride > 0 ? std::min(series.stride, passed) : passed;
  return false;
}

void PlayableLog::name(std::uint64_t offset, std::string what) {
  if (played_.defects.size() < kMaxNamedDefects) {
    played_.defects.push_back({offset, std::move(what)});
  }
}

}  // namespace whirl_twin
