// Declares the fields of a message once, for all users (converters to ROS and LCM, checks, logs,
// tests). A message is a plain struct with
//
//   static constexpr MessageKind kKind{...};
//   template <class Visit> static void fields(Visit& visit);
//
// where fields() passes every field to a visitor, in the order of the .lcm file and by its name
// there and in the .msg file:
//
//   visit.head(field)               instant and subject: LCM's utime, stamp, step, NAME and time,
//                                   ROS's header, step and time; head(): no subject
//   visit.sampled(field)            a sample and its subject: LCM's utime, NAME, sample and time,
//                                   ROS's header, sample and time
//   visit.stamped()                 utime and stamp of a message with its own `time`; no header
//   visit(field, unit, check)       a value
//   visit.array(length, field, ...) an array, and LCM's field with its length
//   visit.along(first, field, ...)  another array, as long as the first
//   visit.rows(length, field)       structs, stored as parallel arrays of the message
//   visit.negated(field)            a flag that the message stores inverted
//   visit.derived(field, of)        a flag computed from the other fields: of(message)
//
// A check is called as check(name, value) or check(name, value, message) and throws
// RejectedMessage. Units are those of the .msg file: "m", "rad/s"; "-": a dimensionless number; "":
// not a number. A field with Stays::kSame is constant in all messages of a channel.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "messages/message_check.h"

namespace whirl_twin {

/// Names and transport properties of a kind of message.
struct MessageKind {
  enum Traits : unsigned {
    kSeries = 1,       ///< every n-th step without a gap; else on change
    kLatched = 2,      ///< on ROS, late subscribers receive the newest
    kJudged = 4,       ///< published by the monitor, not by the monitored twin
    kJointStates = 8,  ///< on ROS, also as sensor_msgs/JointState
    kCommand = 16,     ///< to the twin; not forwarded by bridges, because a log may contain old
                       ///< ones
  };
  const char* name;   ///< "whirl"; its channel is TWIN_<SYSTEM>_WHIRL
  const char* type;   ///< "WhirlState", of the ROS message
  const char* topic;  ///< "*/whirl": below the twin's namespace, * is the subject
  unsigned traits = 0;

  constexpr bool has(Traits trait) const { return (traits & trait) != 0; }
};

/// A field: `in` selects it in a message, `of` in our struct.
template <class In, class Of>
struct Field {
  const char* name;
  In in;
  Of of;
};
template <class In, class Of>
constexpr Field<In, Of> makeField(const char* name, In in, Of of) {
  return {name, in, of};
}

// C++17 has no reflection: a macro derives the text and the pointer from one name.
/// The field `name` of messages, stored in `member` of our struct.
#define TWIN_RENAMED_FIELD(name, member)                          \
  ::whirl_twin::makeField(                                        \
      #name, [](auto& message) -> auto& { return message.name; }, \
      [](auto& state) -> auto& { return state.member; })
#define TWIN_FIELD(name) TWIN_RENAMED_FIELD(name, name)

enum class Stays { kNot, kSame, kSubject };

/// Any value will do.
inline constexpr auto kAnything = [](const char*, const auto&) {};

/// A whole number from low to high.
constexpr auto between(std::int64_t low, std::int64_t high) {
  return [low, high](const char* name, auto value) {
    requireRange(name, static_cast<std::int64_t>(value), low, high);
  };
}

/// Every entry of an array passes a check.
template <class Check>
constexpr auto each(Check check) {
  return [check](const char* name, const auto& values) {
    for (const auto& value : values) {
      check(name, value);
    }
  };
}

template <class Check, class Value, class Message>
void applyCheck(const Check& check, const char* name, const Value& value, const Message& message) {
  if constexpr (std::is_invocable_v<const Check&, const char*, const Value&, const Message&>) {
    check(name, value, message);
  } else {
    check(name, value);
  }
}

/// Base class of the visitors. Each has head(), head(field) and rows(length, field), and
///   value(field, unit, check, stays)   for a value or an array
///   length(length, array), alike(first, array)   where the lengths of arrays matter
/// and defines how it handles negated and derived flags.
template <class Self>
class FieldVisit {
 public:
  template <class F, class Check = decltype(kAnything)>
  void operator()(F field, const char* unit, Check check = kAnything, Stays stays = Stays::kNot) {
    self().value(field, unit, check, stays);
  }
  template <class... F>
  void numbers(const char* unit, F... fields) {
    (self().value(fields, unit, kAnything, Stays::kNot), ...);
  }
  template <class L, class F, class Check = decltype(kAnything)>
  void array(L length, F field, const char* unit, Check check = kAnything,
             Stays stays = Stays::kNot) {
    self().length(length, field);
    self().value(field, unit, check, stays);
  }
  template <class First, class F, class Check = decltype(kAnything)>
  void along(First first, F field, const char* unit, Check check = kAnything) {
    self().value(field, unit, check, Stays::kNot);
    self().alike(first, field);
  }
  template <class First, class... F>
  void numbersAlong(First first, const char* unit, F... fields) {
    (along(first, fields, unit), ...);
  }
  template <class F>
  void negated(F field) {
    self().value(field, "", kAnything, Stays::kNot);
  }
  void stamped() {}
  template <class L, class F>
  void length(L, F) {}
  template <class First, class F>
  void alike(First, F) {}
  template <class F, class Of>
  void derived(F, Of) {}

 private:
  Self& self() { return static_cast<Self&>(*this); }
};

/// Visits the data members of one of our structs, const or not: take(name, value, stays).
template <class State, class Take>
class MemberVisit : public FieldVisit<MemberVisit<State, Take>> {
 public:
  MemberVisit(State& state, Take& take) : state_(state), take_(take) {}

  void head() {
    take_("step", state_.at.step, Stays::kNot);
    take_("time", state_.at.time, Stays::kNot);
    take_("stamp", state_.at.stamp, Stays::kNot);
  }
  template <class F>
  void head(F field) {
    head();
    take_(field.name, field.of(state_), Stays::kSubject);
  }
  template <class F>
  void sampled(F field) {
    take_("sample", state_.at.step, Stays::kNot);
    take_("time", state_.at.time, Stays::kNot);
    take_(field.name, field.of(state_), Stays::kSubject);
  }
  void stamped() { take_("stamp", state_.stamp, Stays::kNot); }
  template <class F, class Check>
  void value(F field, const char*, Check, Stays stays) {
    take_(field.name, field.of(state_), stays);
  }
  template <class L, class F>
  void rows(L, F field) {
    for (auto& row : field.of(state_)) {
      MemberVisit<std::remove_reference_t<decltype(row)>, Take> visit(row, take_);
      std::decay_t<decltype(row)>::fields(visit);
    }
  }

 private:
  State& state_;
  Take& take_;
};

template <class State, class Take>
void eachMember(State& state, Take&& take) {
  MemberVisit<State, std::remove_reference_t<Take>> visit(state, take);
  State::fields(visit);
}

/// Subject of a message: a system, drive or source; "" for one about the whole twin.
template <class State>
std::string subjectOf(const State& state) {
  std::string subject;
  eachMember(state, [&subject](const char*, const auto& value, Stays stays) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
      if (stays == Stays::kSubject) {
        subject = value;
      }
    }
  });
  return subject;
}

}  // namespace whirl_twin
