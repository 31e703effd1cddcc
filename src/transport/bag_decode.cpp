#include "transport/bag_decode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "messages/message_check.h"
#include "transport/lcm_converters.h"

namespace whirl_twin {
namespace {

constexpr const char* kPackage = "whirl_twin/";
constexpr const char* kJointState = "sensor_msgs/JointState";

const RosValue* find(const RosValues& values, const char* name) {
  const auto found = values.find(name);
  return found == values.end() ? nullptr : &found->second;
}

/// Copies the values of a message of a bag into the fields of an LCM type, which fromLcm()
/// validates. A field that the definition in the bag lacks, because it was added later, keeps its
/// default.
template <class State>
class BagFill : public FieldVisit<BagFill<State>> {
 public:
  /// subject: the system, drive or source by the topic.
  BagFill(const RosValues& values, const std::string& subject, LcmType<State>& message)
      : values_(values), subject_(subject), message_(message) {}

  void head() {
    put("step", message_.step);
    put("time", message_.time);
    put("header.stamp", message_.stamp);
    message_.utime = utimeOf(message_.time);
  }
  template <class F>
  void head(F name) {
    head();
    putSubject(name.in(message_));
  }
  template <class F>
  void sampled(F name) {
    put("sample", message_.sample);
    put("time", message_.time);
    putSubject(name.in(message_));
    message_.utime = utimeOf(message_.time);
  }
  template <class F, class Check>
  void value(F field, const char*, Check, Stays) {
    put(field.name, field.in(message_));
  }
  template <class F>
  void negated(F field) {
    put(field.name, field.in(message_));
  }
  template <class F, class Of>
  void derived(F field, Of) {
    put(field.name, field.in(message_));
  }
  template <class L, class F>
  void length(L length, F array) {
    if (const RosValue* const value = find(values_, array.name)) {
      length.in(message_) = static_cast<std::int32_t>(sizeOf(*value));
    }
  }
  template <class L, class F>
  void rows(L length, F rows) {
    using Row = typename std::decay_t<decltype(rows.of(std::declval<State&>()))>::value_type;
    Columns columns(*this);
    Row::fields(columns);
    length.in(message_) = std::max(0, columns.count);
  }

 private:
  struct Columns : FieldVisit<Columns> {
    explicit Columns(BagFill& of) : fill(of) {}
    BagFill& fill;
    int count = -1;  // of rows, by the first column

    template <class F, class Check>
    void value(F field, const char*, Check, Stays) {
      fill.put(field.name, field.in(fill.message_));
      count = count < 0 ? static_cast<int>(field.in(fill.message_).size()) : count;
    }
  };

  /// The frame_id of a command may be empty.
  void putSubject(std::string& to) const {
    put("header.frame_id", to);
    if (State::kKind.has(MessageKind::kCommand) && to.empty()) {
      to = subject_;
    }
  }

  static std::size_t sizeOf(const RosValue& value) {
    return value.whole.size() + value.real.size() + value.text.size();
  }

  template <class Value>
  void put(const char* name, Value& to) const {
    const RosValue* const from = find(values_, name);
    if (from == nullptr) {
      return;
    }
    if (sizeOf(*from) != 1) {
      throw RejectedMessage(fmt::format("{}: expected one value, found {}", name, sizeOf(*from)));
    }
    putOne(name, *from, 0, to);
  }
  template <class Value>
  void put(const char* name, std::vector<Value>& to) const {
    if (const RosValue* const from = find(values_, name)) {
      to.resize(sizeOf(*from));
      for (std::size_t i = 0; i < to.size(); ++i) {
        Value value{};
        putOne(name, *from, i, value);
        to[i] = value;
      }
    }
  }
  template <class Value>
  static void putOne(const char* name, const RosValue& from, std::size_t i, Value& to) {
    if constexpr (std::is_same_v<Value, std::string>) {
      if (i < from.text.size()) {
        to = from.text[i];
        return;
      }
    } else if constexpr (std::is_floating_point_v<Value>) {
      if (i < from.real.size()) {
        to = static_cast<Value>(from.real[i]);
        return;
      }
    } else if (i < from.whole.size() && from.whole[i] >= std::numeric_limits<Value>::min() &&
               from.whole[i] <= std::numeric_limits<Value>::max()) {
      to = static_cast<Value>(from.whole[i]);
      return;
    }
    throw RejectedMessage(fmt::format("{}: the type differs from the twin's", name));
  }

  const RosValues& values_;
  const std::string& subject_;
  LcmType<State>& message_;
};

/// The part of `topic` at the * of the pattern `like`; "" if the pattern has no *.
std::string subjectIn(const std::string& topic, const std::string& like) {
  const std::size_t star = like.find('*');
  return star == std::string::npos || topic.size() < like.size()
             ? ""
             : topic.substr(star, topic.size() + 1 - like.size());
}

/// Splits a topic into the namespace and its last parts, as many as `like` has.
std::pair<std::string, std::string> apart(const std::string& topic, const std::string& like) {
  std::size_t slash = topic.size();
  for (auto parts = 1 + std::count(like.begin(), like.end(), '/'); parts > 0 && slash > 0;
       --parts) {
    slash = topic.rfind('/', slash - 1);
    if (slash == std::string::npos) {
      return {"", topic};
    }
  }
  return topic.empty() ? std::pair(topic, topic)
                       : std::pair(topic.substr(0, slash), topic.substr(slash + 1));
}

}  // namespace

BagDecoder::BagDecoder(const BagConnection& connection) {
  eachKind([&](auto kind) {
    const MessageKind& candidate = decltype(kind)::State::kKind;
    kind_ = connection.type == std::string(kPackage) + candidate.type ? &candidate : kind_;
  });
  joint_state_ = connection.type == kJointState;
  if (joint_state_) {
    kind_ = &state::Measurement::kKind;
  }
  if (kind_ == nullptr) {
    return;
  }
  layout_.emplace(connection.definition);
  const auto [space, topic] =
      apart(connection.topic, joint_state_ ? std::string("*") : std::string(kind_->topic));
  topic_ = topic;
  prefix_ = space.find_first_not_of('/') == std::string::npos ? "" : lcmPrefixOf(space);
}

Message BagDecoder::decode(const BagMessage& message) {
  const RosValues values = layout_->read(message.data, message.size);
  if (joint_state_) {
    return jointState(values);
  }
  std::optional<Message> decoded;
  eachKind([&](auto kind) {
    using State = typename decltype(kind)::State;
    if (kind_ == &State::kKind) {
      LcmType<State> of_lcm = toLcm(State{});
      const std::string subject = subjectIn(topic_, kind_->topic);
      BagFill<State> fill(values, subject, of_lcm);
      State::fields(fill);
      const State state = fromLcm<State>(of_lcm);
      if (topicOf(state) != topic_) {
        throw RejectedMessage(
            fmt::format("expected a message of another topic, found one of {}", topicOf(state)));
      }
      decoded = state;
    }
  });
  return std::move(*decoded);
}

/// Angles by the names of the joints, rates with the suffix _rate; the source is the last part of
/// the topic.
Message BagDecoder::jointState(const RosValues& values) {
  const auto take = [&](const char* name) {
    const RosValue* const value = find(values, name);
    return value == nullptr ? RosValue{} : *value;
  };
  const std::vector<std::string> joints = take("name").text;
  const std::vector<std::int64_t> stamp = take("header.stamp").whole;
  state::Measurement block;
  block.source = topic_;
  for (const bool rates : {false, true}) {
    const std::vector<double> quantity = take(rates ? "velocity" : "position").real;
    if (!quantity.empty() && quantity.size() != joints.size()) {
      throw RejectedMessage(fmt::format("{}: expected {} entries, found {}",
                                        rates ? "velocity" : "position", joints.size(),
                                        quantity.size()));
    }
    for (std::size_t i = 0; i < quantity.size(); ++i) {
      block.channel.push_back(rates ? joints[i] + "_rate" : joints[i]);
      block.value.push_back(quantity[i]);
      block.valid.push_back(std::isfinite(quantity[i]) ? 1 : 0);
    }
  }
  block.unit.assign(block.channel.size(), "");
  block.deviation.assign(block.channel.size(), std::numeric_limits<double>::quiet_NaN());
  block.samples = 1;
  block.first_instant = stamp.empty() ? 0 : stamp.front();
  block.instant = {block.first_instant};
  block.at = {blocks_++, 1.0e-9 * static_cast<double>(block.first_instant), block.first_instant};
  return fromLcm<state::Measurement>(toLcm(block));  // validates
}

}  // namespace whirl_twin
