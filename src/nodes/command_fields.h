// Mapping between the services of simulation_node and twin_command_t and command_answer_t, defined
// once for both directions.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/SetInput.h>
#include <whirl_twin/SetParameter.h>
#include <whirl_twin/SetRealTimeFactor.h>
#include <whirl_twin/SetSpeed.h>
#include <whirl_twin/StepN.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "messages/message_check.h"
#include "whirl_twin/command_answer_t.hpp"
#include "whirl_twin/twin_command_t.hpp"

namespace whirl_twin {

template <class T>
struct ServiceKind {
  using Service = T;
};

/// Calls visit(name, ServiceKind<Service>) for every service that is a command.
template <class Visit>
void eachCommand(Visit&& visit) {
  visit("pause", ServiceKind<std_srvs::Trigger>());
  visit("resume", ServiceKind<std_srvs::Trigger>());
  visit("reset", ServiceKind<std_srvs::Trigger>());
  visit("step", ServiceKind<StepN>());
  visit("set_speed", ServiceKind<SetSpeed>());
  visit("set_parameter", ServiceKind<SetParameter>());
  visit("set_input", ServiceKind<SetInput>());
  visit("set_real_time_factor", ServiceKind<SetRealTimeFactor>());
}

// visit.number(key, field), visit.entries(keys..., values...), visit.name(field),
// visit.time(field), visit.step(field).

template <class V>
void fieldsOf(V&, std_srvs::TriggerRequest&) {}
template <class V>
void fieldsOf(V&, std_srvs::TriggerResponse&) {}
template <class V>
void fieldsOf(V& visit, StepNRequest& r) {
  visit.number("steps", r.steps);
}
template <class V>
void fieldsOf(V& visit, StepNResponse& r) {
  visit.step(r.step);
  visit.number("time", r.time);
}
template <class V>
void fieldsOf(V& visit, SetSpeedRequest& r) {
  visit.name(r.drive);
  visit.number("speed", r.speed);
  visit.number("max_acceleration", r.max_acceleration);
  visit.number("max_jerk", r.max_jerk);
}
template <class V>
void fieldsOf(V& visit, SetSpeedResponse& r) {
  visit.number("duration", r.duration);
  visit.number("speed", r.speed);
}
template <class V>
void fieldsOf(V& visit, SetParameterRequest& r) {
  visit.name(r.system);
  visit.entry(r.parameter, r.value);
  visit.entries(r.further_parameters, r.further_values);
  visit.time(r.ramp);
}
template <class V>
void fieldsOf(V& visit, SetParameterResponse& r) {
  visit.number("previous", r.previous);
  visit.step(r.step);
}
template <class V>
void fieldsOf(V& visit, SetInputRequest& r) {
  visit.name(r.system);
  visit.entry(r.input, r.value);
  visit.time(r.duration);
}
template <class V>
void fieldsOf(V& visit, SetInputResponse& r) {
  visit.step(r.step);
}
template <class V>
void fieldsOf(V& visit, SetRealTimeFactorRequest& r) {
  visit.number("factor", r.factor);
}
template <class V>
void fieldsOf(V&, SetRealTimeFactorResponse&) {}

/// Copies a service into a message.
template <class Message>
class TellFields {
 public:
  explicit TellFields(Message& to) : to_(to) {}

  template <class Number>
  void number(const char* key, const Number& value) {
    entry(key, static_cast<double>(value));
  }
  void entry(const std::string& key, double value) {
    to_.keys.push_back(key);
    to_.values.push_back(value);
    to_.count = static_cast<std::int32_t>(to_.keys.size());
  }
  void entries(const std::vector<std::string>& keys, const std::vector<double>& values) {
    to_.keys.insert(to_.keys.end(), keys.begin(), keys.end());
    to_.values.insert(to_.values.end(), values.begin(), values.end());
    to_.values.resize(to_.keys.size(), std::nan(""));
    to_.count = static_cast<std::int32_t>(to_.keys.size());
  }
  void name(const std::string& name) { to_.name = name; }
  void time(double time) { to_.time = time; }
  void step(std::int64_t step) { to_.step = step; }

 private:
  Message& to_;
};

/// Copies a message into a service. finish() throws RejectedMessage with all errors.
template <class Message>
class ReadFields {
 public:
  explicit ReadFields(const Message& from) : from_(from) {}

  template <class Number>
  void number(const char* key, Number& value) {
    known_.emplace_back(key);
    for (std::size_t i = 0; i < from_.keys.size(); ++i) {
      if (from_.keys[i] == key) {
        return set(key, from_.values[i], value);
      }
    }
    faults_.push_back(fmt::format("{}: missing", key));
    if constexpr (std::is_floating_point_v<Number>) {
      value = std::nan("");
    }
  }
  void entry(std::string& key, double& value) {
    free_ = true;
    if (from_.keys.empty()) {
      faults_.emplace_back("keys: expected at least one, found none");
      return;
    }
    key = from_.keys.front();
    value = from_.values.front();
    taken_ = 1;
  }
  void entries(std::vector<std::string>& keys, std::vector<double>& values) {
    for (; taken_ < from_.keys.size(); ++taken_) {
      keys.push_back(from_.keys[taken_]);
      values.push_back(from_.values[taken_]);
    }
  }
  void name(std::string& name) { name = from_.name; }
  void time(double& time) { time = from_.time; }
  void step(std::int64_t& step) { step = from_.step; }

  void finish() {
    if (free_ && taken_ < from_.keys.size()) {
      faults_.push_back(fmt::format("keys: expected one, found {}", from_.keys.size()));
    }
    for (const std::string& key : from_.keys) {
      if (!free_ && std::find(known_.begin(), known_.end(), key) == known_.end()) {
        faults_.push_back(fmt::format("{}: unknown key{}", printable(key), hint(key, known_)));
      }
    }
    if (!faults_.empty()) {
      throw RejectedMessage(fmt::format("{}", fmt::join(faults_, "; ")));
    }
  }

 private:
  template <class Number>
  void set(const char* key, double from, Number& value) {
    if constexpr (std::is_integral_v<Number>) {
      constexpr double kMost = static_cast<double>(std::numeric_limits<Number>::max());
      if (!(from >= 0.0 && from <= kMost && from == std::floor(from))) {
        faults_.push_back(
            fmt::format("{}: must be a whole number from 0 to {:.0f}, found {}", key, kMost, from));
        return;
      }
    }
    value = static_cast<Number>(from);
  }

  const Message& from_;
  std::vector<std::string> known_, faults_;
  bool free_ = false;      // keys are names of the scene
  std::size_t taken_ = 0;  // keys read
};

}  // namespace whirl_twin
