// State <-> LCM type. toLcm() never fails; fromLcm() throws RejectedMessage for an invalid message:
// an illegal name, arrays of different lengths, a number outside its range, a utime that does not
// match the time.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "messages/message.h"
#include "transport/message_fields.h"
#include "whirl_twin/alarm_command_t.hpp"
#include "whirl_twin/alert_t.hpp"
#include "whirl_twin/controller_command_t.hpp"
#include "whirl_twin/controller_margins_t.hpp"
#include "whirl_twin/controller_measurement_t.hpp"
#include "whirl_twin/controller_state_t.hpp"
#include "whirl_twin/drive_state_t.hpp"
#include "whirl_twin/ensemble_state_t.hpp"
#include "whirl_twin/follow_state_t.hpp"
#include "whirl_twin/input_command_t.hpp"
#include "whirl_twin/loop_statistics_t.hpp"
#include "whirl_twin/measurement_t.hpp"
#include "whirl_twin/monitor_status_t.hpp"
#include "whirl_twin/motor_state_t.hpp"
#include "whirl_twin/order_state_t.hpp"
#include "whirl_twin/parameter_change_t.hpp"
#include "whirl_twin/pendulum_state_t.hpp"
#include "whirl_twin/scene_text_t.hpp"
#include "whirl_twin/stability_margin_t.hpp"
#include "whirl_twin/whirl_state_t.hpp"

namespace whirl_twin {

// The LCM type of every kind of message.

// Declared only: the return type is the LCM type of the kind.
whirl_state_t lcmTypeOf(const state::WhirlState&);
pendulum_state_t lcmTypeOf(const state::PendulumState&);
drive_state_t lcmTypeOf(const state::DriveState&);
motor_state_t lcmTypeOf(const state::MotorState&);
ensemble_state_t lcmTypeOf(const state::EnsembleState&);
stability_margin_t lcmTypeOf(const state::StabilityMargin&);
parameter_change_t lcmTypeOf(const state::ParameterChange&);
loop_statistics_t lcmTypeOf(const state::LoopStatistics&);
measurement_t lcmTypeOf(const state::Measurement&);
input_command_t lcmTypeOf(const state::InputCommand&);
alert_t lcmTypeOf(const state::Alert&);
monitor_status_t lcmTypeOf(const state::MonitorStatus&);
order_state_t lcmTypeOf(const state::OrderState&);
alarm_command_t lcmTypeOf(const state::AlarmCommand&);
follow_state_t lcmTypeOf(const state::FollowState&);
controller_state_t lcmTypeOf(const state::ControllerState&);
controller_margins_t lcmTypeOf(const state::ControllerMargins&);
controller_measurement_t lcmTypeOf(const state::ControllerMeasurement&);
controller_command_t lcmTypeOf(const state::ControllerCommand&);
scene_text_t lcmTypeOf(const state::SceneText&);

template <class State>
using LcmType = decltype(lcmTypeOf(std::declval<State>()));

template <class State>
class LcmPut : public PutFields<LcmPut<State>, State, LcmType<State>> {
 public:
  LcmPut(const State& state, LcmType<State>& message)
      : PutFields<LcmPut, State, LcmType<State>>(state, message) {}

  void head() {
    this->message_.utime = utimeOf(this->state_.at.time);
    this->message_.stamp = this->state_.at.stamp;
    this->message_.step = this->state_.at.step;
    this->message_.time = this->state_.at.time;
  }
  template <class F>
  void head(F name) {
    head();
    name.in(this->message_) = name.of(this->state_);
  }
  template <class F>
  void sampled(F name) {
    this->message_.utime = utimeOf(this->state_.at.time);
    name.in(this->message_) = name.of(this->state_);
    this->message_.sample = this->state_.at.step;
    this->message_.time = this->state_.at.time;
  }
  void stamped() {
    this->message_.utime = utimeOf(this->state_.time);
    this->message_.stamp = this->state_.stamp;
  }
  template <class L, class F>
  void length(L length, F array) {
    length.in(this->message_) = static_cast<std::int32_t>(array.of(this->state_).size());
  }
  /// Truncates or pads an array of another length: LCM has one length for all.
  template <class First, class F>
  void alike(First first, F array) {
    array.in(this->message_).resize(first.of(this->state_).size());
  }
};

template <class State>
class LcmTake : public TakeFields<LcmTake<State>, State, LcmType<State>> {
 public:
  LcmTake(const LcmType<State>& message, State& state)
      : TakeFields<LcmTake, State, LcmType<State>>(message, state) {}

  void head() {
    const auto& message = this->message_;
    requireStep(message.step);
    requireTime("time", message.time);
    requireUtimeAndStamp();
    this->state_.at = {message.step, message.time, message.stamp};
  }
  template <class F>
  void head(F name) {
    this->value(name, "", requireName, Stays::kSubject);
    head();
  }
  /// The utime of an answer is not checked: its sender sets it.
  template <class F>
  void sampled(F name) {
    this->value(name, "", requireName, Stays::kSubject);
    requireTime("time", this->message_.time);
    this->state_.at = {this->message_.sample, this->message_.time, 0};
  }
  void stamped() {
    requireUtimeAndStamp();
    this->state_.stamp = this->message_.stamp;
  }
  template <class L, class F>
  void length(L length, F array) {
    requireLength(array.name, array.in(this->message_).size(), length.in(this->message_));
  }
  template <class L, class F>
  void rows(L length, F rows) {
    TakeFields<LcmTake, State, LcmType<State>>::rows(length, rows);
    requireLength(rows.name, rows.of(this->state_).size(), length.in(this->message_));
  }

 private:
  void requireUtimeAndStamp() {
    const auto& message = this->message_;
    if (message.utime != utimeOf(message.time)) {
      throw RejectedMessage(fmt::format("utime: expected {} us, the time of {} s, found {}",
                                        utimeOf(message.time), message.time, message.utime));
    }
    requireStamp(message.stamp);
  }
};

template <class State>
LcmType<State> toLcm(const State& state) {
  LcmType<State> message;
  LcmPut<State> put(state, message);
  State::fields(put);
  return message;
}

template <class State>
State fromLcm(const LcmType<State>& message) {
  State state;
  LcmTake<State> take(message, state);
  State::fields(take);
  return state;
}

// Serialization of a message as an LCM event.

/// The payload of a message; returns its timestamp in a log of simulated time [us].
template <class State>
std::int64_t encode(const State& state, std::vector<std::uint8_t>& payload) {
  const LcmType<State> message = toLcm(state);
  payload.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(payload.data(), 0, static_cast<int>(payload.size()));
  return message.utime;
}

}  // namespace whirl_twin
