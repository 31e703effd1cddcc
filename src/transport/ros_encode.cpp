#include "transport/ros_encode.h"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "messages/message_check.h"
#include "transport/channels.h"
#include "transport/lcm_converters.h"
#include "transport/ros_definitions.h"

namespace whirl_twin {
namespace {

const RosDefinition& definitionOf(const std::string& type) {
  const auto& all = rosDefinitions();
  return *std::find_if(all.begin(), all.end(),
                       [&](const RosDefinition& known) { return known.type == type; });
}

void putHeader(std::int64_t stamp, const std::string& frame, LittleEndian& bytes) {
  constexpr std::int64_t kSecond = 1'000'000'000;  // ns
  const std::int64_t within = std::clamp<std::int64_t>(stamp, 0, kMaxStamp);
  bytes.number(0, 4);  // seq
  bytes.number(static_cast<std::uint64_t>(within / kSecond), 4);
  bytes.number(static_cast<std::uint64_t>(within % kSecond), 4);
  bytes.text(frame);
}

/// Fields in the order of the .msg file, with its widths (the letters of ros_definitions.h); the
/// values come from the LCM type.
template <class State>
class RosWrite : public FieldVisit<RosWrite<State>> {
 public:
  RosWrite(const State& state, const char* widths, LittleEndian& bytes)
      : state_(state), message_(toLcm(state)), widths_(widths), bytes_(bytes) {}

  void head() { putHead(""); }
  template <class F>
  void head(F name) {
    putHead(name.of(state_));
  }
  template <class F>
  void sampled(F name) {
    putHead(name.of(state_));
  }
  template <class F, class Check>
  void value(F field, const char*, Check, Stays) {
    put(field.in(message_));
  }
  template <class L, class F>
  void rows(L, F field) {
    using Rows = std::decay_t<decltype(field.of(std::declval<State&>()))>;
    Rows::value_type::fields(*this);
  }
  template <class F, class Of>
  void derived(F field, Of) {
    put(field.in(message_));
  }

 private:
  void putHead(const std::string& name) {
    putHeader(state_.at.stamp, name, bytes_);
    put(state_.at.step);
    put(state_.at.time);
  }
  template <class Value>
  void put(const Value& value) {
    putOne(value, *widths_++);
  }
  template <class Value>
  void put(const std::vector<Value>& values) {
    bytes_.number(values.size(), 4);
    const auto of_entry = static_cast<char>(*widths_++ - 'A' + 'a');
    for (const Value value : values) {
      putOne(value, of_entry);
    }
  }
  void put(const std::vector<std::string>& values) {
    bytes_.number(values.size(), 4);
    ++widths_;
    for (const std::string& value : values) {
      bytes_.text(value);
    }
  }
  void putOne(const std::string& value, char) { bytes_.text(value); }
  void putOne(double value, char) { bytes_.real(value); }
  template <class Whole>
  void putOne(Whole value, char width) {
    bytes_.number(static_cast<std::uint64_t>(value), width == 'b' ? 1 : width == 'i' ? 4 : 8);
  }

  const State& state_;
  LcmType<State> message_;
  const char* widths_;
  LittleEndian& bytes_;
};

template <class State>
void writeFields(const State& state, const char* widths, LittleEndian& bytes) {
  RosWrite<State> write(state, widths, bytes);
  State::fields(write);
}

void writeAlerts(const std::vector<const state::Alert*>& alerts, std::int64_t stamp,
                 LittleEndian& bytes) {
  putHeader(stamp, "", bytes);
  bytes.number(alerts.size(), 4);
  for (const state::Alert* alert : alerts) {
    writeFields(*alert, definitionOf("whirl_twin/Alert").widths, bytes);
  }
}

/// Most severe first, then the oldest.
bool isMoreUrgent(const state::Alert* a, const state::Alert* b) {
  if (a->severity != b->severity) {
    return a->severity > b->severity;
  }
  return a->raised_time != b->raised_time ? a->raised_time < b->raised_time : a->id < b->id;
}

}  // namespace

const RosDefinition& rosDefinitionOf(const MessageKind& kind) {
  return definitionOf(std::string("whirl_twin/") + kind.type);
}

void RosEncoder::go(const MessageKind& kind, const std::string& topic) {
  const auto [place, is_new] = topics_.try_emplace(topic);
  if (is_new) {
    const RosDefinition& of = rosDefinitionOf(kind);
    place->second = {namespace_ + "/" + topic, of.type, of.text, of.md5sum};
    place->second.latching = kind.has(MessageKind::kLatched);
  }
  topic_ = &place->second;
}

template <class State>
void RosEncoder::put(const State& state) {
  static const char* const widths = rosDefinitionOf(State::kKind).widths;
  writeFields(state, widths, bytes_);
}

void RosEncoder::put(const state::Alert& alert) {
  if (alert.time < last_alert_) {
    active_.clear();  // the log or the twin has restarted
  }
  last_alert_ = alert.time;
  if (alert.raised) {
    active_[alert.id] = alert;
  } else {
    active_.erase(alert.id);
  }
  std::vector<const state::Alert*> list;
  for (const auto& entry : active_) {
    list.push_back(&entry.second);
  }
  std::sort(list.begin(), list.end(), isMoreUrgent);
  writeAlerts(list, alert.stamp, bytes_);
}

const LittleEndian& RosEncoder::encode(const std::vector<state::Alert>& alerts,
                                       std::int64_t stamp) {
  bytes_.clear();
  go(state::Alert::kKind, topicName(state::Alert::kKind));
  std::vector<const state::Alert*> list;
  for (const state::Alert& alert : alerts) {
    list.push_back(&alert);
  }
  writeAlerts(list, stamp, bytes_);
  return bytes_;
}

const LittleEndian& RosEncoder::encode(const Message& message) {
  bytes_.clear();
  std::visit(
      [this](const auto& state) {
        go(std::decay_t<decltype(state)>::kKind, topicOf(state));
        put(state);
      },
      message);
  return bytes_;
}

}  // namespace whirl_twin
