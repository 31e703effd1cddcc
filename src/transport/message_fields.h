// Conversion of the structs to LCM types and ROS messages and, with validation, back: the code that
// all kinds share. The fields of each kind are listed in messages/, see fields.h.
#pragma once

#include <cstddef>
#include <type_traits>

#include "messages/fields.h"

namespace whirl_twin {

template <class From, class To>
void convert(const From& from, To& to) {
  if constexpr (std::is_same_v<To, bool>) {
    to = from != 0;
  } else if constexpr (std::is_arithmetic_v<To> || std::is_enum_v<To>) {
    to = static_cast<To>(from);
  } else if constexpr (std::is_same_v<From, To>) {
    to = from;
  } else {
    to.assign(from.begin(), from.end());  // arrays of integers of another width or sign
  }
}

/// Copies the fields of a struct into a message; a derived class for its kind writes the head.
template <class Self, class State, class Message>
class PutFields : public FieldVisit<Self> {
 public:
  PutFields(const State& state, Message& message) : state_(state), message_(message) {}

  template <class F, class Check>
  void value(F field, const char*, Check, Stays) {
    convert(field.of(state_), field.in(message_));
  }
  template <class F>
  void negated(F field) {
    convert(!field.of(state_), field.in(message_));
  }
  template <class F, class Of>
  void derived(F field, Of of) {
    convert(of(state_), field.in(message_));
  }
  template <class L, class F>
  void rows(L length, F rows) {
    using Rows = std::decay_t<decltype(rows.of(state_))>;
    PutColumns<Rows> put(rows.of(state_), message_);
    Rows::value_type::fields(put);
    static_cast<Self*>(this)->length(length, rows);
  }

 protected:
  const State& state_;
  Message& message_;

 private:
  template <class Rows>
  struct PutColumns : FieldVisit<PutColumns<Rows>> {
    PutColumns(const Rows& from, Message& to) : rows(from), message(to) {}
    const Rows& rows;
    Message& message;

    template <class F, class Check>
    void value(F field, const char*, Check, Stays) {
      for (const auto& row : rows) {
        field.in(message).push_back(field.of(row));
      }
    }
  };
};

/// Copies the fields of a message into a struct. Throws RejectedMessage.
template <class Self, class State, class Message>
class TakeFields : public FieldVisit<Self> {
 public:
  TakeFields(const Message& message, State& state) : message_(message), state_(state) {}

  template <class F, class Check>
  void value(F field, const char*, Check check, Stays) {
    applyCheck(check, field.name, field.in(message_), message_);
    convert(field.in(message_), field.of(state_));
  }
  template <class First, class F>
  void alike(First first, F field) {
    requireLength(field.name, field.in(message_).size(),
                  static_cast<std::int64_t>(first.in(message_).size()));
  }
  template <class F>
  void negated(F field) {
    requireFlag(field.name, field.in(message_));
    field.of(state_) = field.in(message_) == 0;
  }
  template <class F, class Of>
  void derived(F field, Of of) {
    const int expected = of(message_) ? 1 : 0;
    requireRange(field.name, field.in(message_), expected, expected);
  }
  /// The first column determines the number of rows.
  template <class L, class F>
  void rows(L, F rows) {
    using Rows = std::decay_t<decltype(rows.of(state_))>;
    TakeColumns<Rows> take(rows.of(state_), message_);
    Rows::value_type::fields(take);
  }

 protected:
  const Message& message_;
  State& state_;

 private:
  template <class Rows>
  struct TakeColumns : FieldVisit<TakeColumns<Rows>> {
    TakeColumns(Rows& to, const Message& from) : rows(to), message(from) {}
    Rows& rows;
    const Message& message;
    bool first = true;

    template <class F, class Check>
    void value(F field, const char*, Check check, Stays) {
      const auto& column = field.in(message);
      rows.resize(first ? column.size() : rows.size());
      first = false;
      requireLength(field.name, column.size(), static_cast<std::int64_t>(rows.size()));
      for (std::size_t i = 0; i < column.size(); ++i) {
        applyCheck(check, field.name, column[i], message);
        field.of(rows[i]) = column[i];
      }
    }
  };
};

}  // namespace whirl_twin
