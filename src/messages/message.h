// All kinds of messages that leave or enter a twin, one row each.
#pragma once

#include <variant>

#include "messages/alarm_command.h"
#include "messages/alert.h"
#include "messages/controller_exchange.h"
#include "messages/controller_margins.h"
#include "messages/controller_state.h"
#include "messages/follow_state.h"
#include "messages/input_command.h"
#include "messages/loop_statistics.h"
#include "messages/measurement.h"
#include "messages/monitor_status.h"
#include "messages/order_state.h"
#include "messages/scene_text.h"
#include "messages/stability_margin.h"
#include "messages/states.h"

namespace whirl_twin {

/// Whatever the twin can say, or be told.
using Message =
    std::variant<state::WhirlState, state::PendulumState, state::DriveState, state::MotorState,
                 state::EnsembleState, state::StabilityMargin, state::ParameterChange,
                 state::LoopStatistics, state::Measurement, state::InputCommand, state::Alert,
                 state::MonitorStatus, state::OrderState, state::AlarmCommand, state::FollowState,
                 state::ControllerState, state::ControllerMargins, state::ControllerMeasurement,
                 state::ControllerCommand, state::SceneText>;

/// A kind as a value: typename decltype(kind)::State.
template <class T>
struct KindOf {
  using State = T;
};

namespace detail {
template <class Visit, class... States>
void eachKindOf(const std::variant<States...>*, Visit& visit) {
  (visit(KindOf<States>{}), ...);
}
}  // namespace detail

/// visit(KindOf<State>) for every kind.
template <class Visit>
void eachKind(Visit&& visit) {
  detail::eachKindOf(static_cast<const Message*>(nullptr), visit);
}

/// [s], simulated.
template <class State>
double timeOf(const State& state) {
  return state.at.time;
}
inline double timeOf(const state::Alert& alert) {
  return alert.time;
}

}  // namespace whirl_twin
