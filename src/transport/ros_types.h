// The ROS message of every kind of message.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "messages/message.h"
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

// Never called: the type that each returns is the one that its kind has.
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
Alert rosTypeOf(const state::Alert&);  // one of an AlertArray

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

/// The struct of a ROS message.
template <class Type>
using StateOf = typename detail::StateOf<Type, Message>::State;

}  // namespace whirl_twin
