// The LCM type of every kind of message.
#pragma once

#include "messages/message.h"
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

// Never called: the type that each returns is the one that its kind has.
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

}  // namespace whirl_twin
