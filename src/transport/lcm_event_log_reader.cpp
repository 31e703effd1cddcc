#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

#include "messages/message_check.h"
#include "transport/event_scan.h"
#include "transport/lcm_decode.h"
#include "transport/lcm_event_log.h"
#include "transport/step_continuity.h"

namespace whirl_twin {
namespace {

/// Timestamps are times of reception: tolerance for small backward clock corrections [us].
constexpr std::int64_t kClockSlack = 1000000;
/// Upper limit of plausible timestamps, 30,000 years from now [us].
constexpr std::int64_t kLatest = 1'000'000'000'000'000'000;

/// Description of the content of a channel.
template <class State>
std::string subject(const State& state) {
  std::string subject;
  const auto add = [&subject](const char* name, const auto& value, Stays stays) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
      if (stays == Stays::kSame) {
        subject += fmt::format(", {} {}", name, fmt::join(value, " "));
      }
    } else if constexpr (std::is_same_v<Value, std::string> || std::is_integral_v<Value>) {
      if (stays != Stays::kNot) {
        subject += fmt::format("{}{} {}", subject.empty() ? "" : ", ", name, value);
      }
    }
  };
  eachMember(state, add);
  return subject;
}

class LogJudge {
 public:
  LogJudge(LogSummary& summary, const std::string& prefix) : summary_(summary), prefix_(prefix) {}

  void take(const RawEvent& event);
  void takeDamage(const EventScan& scan, bool truncated);
  void finish();

 private:
  struct ChannelTrace {
    ChannelSummary summary;
    StepContinuity steps;
    std::string subject;
  };

  void addDefect(std::uint64_t offset, std::string what);
  void checkOrder(const RawEvent& event);
  ChannelTrace& traceOf(const std::string& channel);
  void takeState(const RawEvent& event, ChannelTrace& trace);

  LogSummary& summary_;
  std::string prefix_;
  std::map<std::string, ChannelTrace> traces_;
  std::optional<std::int64_t> expected_number_ = 0;
  std::optional<std::int64_t> last_timestamp_;
};

void LogJudge::addDefect(std::uint64_t offset, std::string what) {
  ++summary_.defect_count;
  if (summary_.defects.size() < kMaxNamedDefects) {
    summary_.defects.push_back({offset, std::move(what)});
  }
}

void LogJudge::takeDamage(const EventScan& scan, bool truncated) {
  addDefect(scan.damageOffset(), scan.damage());
  summary_.unreadable_bytes += scan.offset() - scan.damageOffset();
  summary_.truncated = summary_.truncated || truncated;
  expected_number_.reset();  // the number of events lost there is not known
}

void LogJudge::checkOrder(const RawEvent& event) {
  // A logger that appends to a log numbers its events from 0 again.
  if (expected_number_ && event.number != *expected_number_ && event.number != 0) {
    addDefect(event.offset,
              fmt::format("event number: expected {}, found {}", *expected_number_, event.number));
  }
  expected_number_.reset();
  if (event.number >= 0 && event.number < std::numeric_limits<std::int64_t>::max()) {
    expected_number_ = event.number + 1;
  }
  if (event.timestamp < -kLatest || event.timestamp > kLatest) {
    addDefect(event.offset, fmt::format("timestamp: expected from {} to {} us, found {}", -kLatest,
                                        kLatest, event.timestamp));
    return;
  }
  if (last_timestamp_ && event.timestamp < *last_timestamp_ - kClockSlack) {
    addDefect(event.offset, fmt::format("timestamp: expected at least {} us, found {}",
                                        *last_timestamp_ - kClockSlack, event.timestamp));
  }
  last_timestamp_ = event.timestamp;
}

LogJudge::ChannelTrace& LogJudge::traceOf(const std::string& channel) {
  const auto [place, is_new] = traces_.try_emplace(channel);
  if (is_new) {
    const auto parsed = parseChannel(channel, prefix_);
    auto& summary = place->second.summary;
    summary.channel = channel;
    summary.kind = parsed ? parsed->kind->name : "other";
    summary.first_time = summary.last_time = std::numeric_limits<double>::quiet_NaN();
  }
  return place->second;
}

void LogJudge::takeState(const RawEvent& event, ChannelTrace& trace) {
  const Message message = decodeEvent(event.channel, event.data, event.size, prefix_);
  const auto about = std::visit([](const auto& state) { return subject(state); }, message);
  const double time = std::visit([](const auto& state) { return timeOf(state); }, message);
  if (trace.summary.events == 0) {
    trace.subject = about;
    trace.summary.first_time = time;
  } else if (about != trace.subject) {
    throw RejectedMessage(
        fmt::format("expected a message of {}, found one of {}", trace.subject, about));
  }
  trace.summary.last_time = time;
  if (const auto step = seriesStep(message)) {
    trace.steps.add(*step);
  }
}

void LogJudge::take(const RawEvent& event) {
  if (!std::all_of(event.channel.begin(), event.channel.end(),
                   [](char c) { return c > 0x20 && c < 0x7f; })) {
    addDefect(event.offset, "channel name: expected printable characters");
    return;
  }
  checkOrder(event);
  auto& trace = traceOf(event.channel);
  try {
    if (trace.summary.kind != "other") {
      if (event.data == nullptr) {
        throw RejectedMessage(fmt::format("payload: expected at most {} bytes, found {}",
                                          EventScan::kMaxPayload, event.size));
      }
      takeState(event, trace);
    } else if (event.data != nullptr && hasTwinFingerprint(event.data, event.size)) {
      throw RejectedMessage("a message of a twin on the wrong channel");
    }
  } catch (const RejectedMessage& why) {
    ++trace.summary.rejected;
    addDefect(event.offset, event.channel + ": " + why.what());
    return;
  }
  if (summary_.events == 0) {
    summary_.first_timestamp = event.timestamp;
  }
  summary_.last_timestamp = event.timestamp;
  ++summary_.events;
  ++trace.summary.events;
  trace.summary.bytes += event.size;
}

void LogJudge::finish() {
  for (auto& [channel, trace] : traces_) {
    auto& summary = trace.summary;
    summary.stride = trace.steps.stride();
    summary.gaps = trace.steps.gaps();
    summary.lost = trace.steps.lost();
    summary.repeated = trace.steps.repeated();
    summary.late = trace.steps.late();
    summary.backward = trace.steps.backward();
    summary_.channels.push_back(std::move(summary));
  }
}

}  // namespace

bool LogSummary::continuous() const {
  return std::all_of(channels.begin(), channels.end(), [](const ChannelSummary& channel) {
    return channel.gaps == 0 && channel.repeated == 0 && channel.late == 0 && channel.backward == 0;
  });
}

LogSummary readEventLog(const std::string& path, const std::string& prefix) {
  EventScan scan(path);
  LogSummary summary;
  summary.path = path;
  summary.size = scan.size();
  LogJudge judge(summary, prefix);
  RawEvent event;
  for (auto found = scan.next(event); found != EventScan::Found::kEnd; found = scan.next(event)) {
    if (found == EventScan::Found::kEvent) {
      judge.take(event);
    } else {
      judge.takeDamage(scan, found == EventScan::Found::kTruncation);
    }
  }
  judge.finish();
  return summary;
}

}  // namespace whirl_twin
