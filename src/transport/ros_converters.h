// State <-> ROS message. A header carries the stamp of the state's instant and, as frame_id, its
// system, drive or source. toRos() never fails; fromRos() throws RejectedMessage for an invalid
// message: an illegal name, arrays of different lengths, a number outside its range.
#pragma once

#include <ros/time.h>
#include <sensor_msgs/JointState.h>

#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "messages/message.h"
#include "transport/message_fields.h"
#include "whirl_twin/AlarmCommand.h"
#include "whirl_twin/AlertArray.h"
#include "whirl_twin/ControllerCommand.h"
#include "whirl_twin/ControllerMargins.h"
#include "whirl_twin/ControllerMeasurement.h"
#include "whirl_twin/ControllerState.h"
#include "whirl_twin/DriveState.h"
#include "whirl_twin/EnsembleState.h"
#include "whirl_twin/FollowState.h"
#include "whirl_twin/InputCommand.h"
#include "whirl_twin/LoopStatistics.h"
#include "whirl_twin/Measurement.h"
#include "whirl_twin/MonitorStatus.h"
#include "whirl_twin/MotorState.h"
#include "whirl_twin/OrderState.h"
#include "whirl_twin/ParameterChange.h"
#include "whirl_twin/PendulumState.h"
#include "whirl_twin/SceneText.h"
#include "whirl_twin/StabilityMargin.h"
#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

// The ROS message type of every kind of message.

// Declared only: the return type is the ROS message type of the kind.
WhirlState rosTypeOf(const state::WhirlState&);
PendulumState rosTypeOf(const state::PendulumState&);
DriveState rosTypeOf(const state::DriveState&);
MotorState rosTypeOf(const state::MotorState&);
EnsembleState rosTypeOf(const state::EnsembleState&);
StabilityMargin rosTypeOf(const state::StabilityMargin&);
ParameterChange rosTypeOf(const state::ParameterChange&);
LoopStatistics rosTypeOf(const state::LoopStatistics&);
Measurement rosTypeOf(const state::Measurement&);
InputCommand rosTypeOf(const state::InputCommand&);
MonitorStatus rosTypeOf(const state::MonitorStatus&);
OrderState rosTypeOf(const state::OrderState&);
AlarmCommand rosTypeOf(const state::AlarmCommand&);
FollowState rosTypeOf(const state::FollowState&);
ControllerState rosTypeOf(const state::ControllerState&);
ControllerMargins rosTypeOf(const state::ControllerMargins&);
ControllerMeasurement rosTypeOf(const state::ControllerMeasurement&);
ControllerCommand rosTypeOf(const state::ControllerCommand&);
SceneText rosTypeOf(const state::SceneText&);
Alert rosTypeOf(const state::Alert&);  // element of an AlertArray

template <class State>
using RosType = decltype(rosTypeOf(std::declval<State>()));

namespace detail {
template <class Type, class Kinds>
struct StateOf {};
template <class Type, class First, class... Others>
struct StateOf<Type, std::variant<First, Others...>>
    : std::conditional_t<std::is_same_v<Type, RosType<First>>, KindOf<First>,
                         StateOf<Type, std::variant<Others...>>> {};
}  // namespace detail

/// The struct of a ROS message type.
template <class Type>
using StateOf = typename detail::StateOf<Type, Message>::State;

/// A stamp [ns] as ROS time, clamped to the range of ROS time (0 to 2106).
ros::Time toRosTime(std::int64_t stamp);

template <class State>
class RosPut : public PutFields<RosPut<State>, State, RosType<State>> {
 public:
  RosPut(const State& state, RosType<State>& message)
      : PutFields<RosPut, State, RosType<State>>(state, message) {}

  void head() {
    this->message_.header.stamp = toRosTime(this->state_.at.stamp);
    this->message_.step = this->state_.at.step;
    this->message_.time = this->state_.at.time;
  }
  template <class F>
  void head(F name) {
    head();
    this->message_.header.frame_id = name.of(this->state_);
  }
  template <class F>
  void sampled(F name) {
    this->message_.header.stamp = toRosTime(this->state_.at.stamp);
    this->message_.header.frame_id = name.of(this->state_);
    this->message_.sample = this->state_.at.step;
    this->message_.time = this->state_.at.time;
  }
};

template <class State>
class RosTake : public TakeFields<RosTake<State>, State, RosType<State>> {
 public:
  RosTake(const RosType<State>& message, State& state)
      : TakeFields<RosTake, State, RosType<State>>(message, state) {}

  void head() {
    requireStep(this->message_.step);
    requireTime("time", this->message_.time);
    this->state_.at = {this->message_.step, this->message_.time,
                       static_cast<std::int64_t>(this->message_.header.stamp.toNSec())};
  }
  template <class F>
  void head(F name) {
    head();
    requireName("header.frame_id", this->message_.header.frame_id);
    name.of(this->state_) = this->message_.header.frame_id;
  }
  template <class F>
  void sampled(F name) {
    requireTime("time", this->message_.time);
    requireName("header.frame_id", this->message_.header.frame_id);
    this->state_.at = {this->message_.sample, this->message_.time,
                       static_cast<std::int64_t>(this->message_.header.stamp.toNSec())};
    name.of(this->state_) = this->message_.header.frame_id;
  }
};

template <class State>
RosType<State> toRos(const State& state) {
  RosType<State> message;
  RosPut<State> put(state, message);
  State::fields(put);
  return message;
}

template <class Type>
StateOf<Type> fromRos(const Type& message) {
  StateOf<Type> state;
  RosTake<StateOf<Type>> take(message, state);
  StateOf<Type>::fields(take);
  return state;
}

/// The complete list of active alerts, stamped with the instant [ns] it holds at.
AlertArray toRos(const std::vector<state::Alert>& alerts, std::int64_t stamp);
/// Each alert gets the stamp of the list: an Alert has no stamp.
std::vector<state::Alert> fromRos(const AlertArray& message);

/// The same state as sensor_msgs/JointState: position and rate of every coordinate, effort empty.
/// The coordinates of a rotor are x and y of the disc centre.
sensor_msgs::JointState toJointState(const state::WhirlState& whirl);
sensor_msgs::JointState toJointState(const state::PendulumState& pendulum);

}  // namespace whirl_twin
