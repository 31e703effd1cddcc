// State <-> LCM type, one converter a direction. toLcm() never fails; fromLcm() throws
// RejectedMessage for a message that cannot be meant: an illegal name, arrays of different lengths,
// a number outside its range, a utime that is not the time.
#pragma once

#include "messages/alert.h"
#include "messages/message_check.h"
#include "messages/stability_margin.h"
#include "messages/states.h"
#include "whirl_twin/alert_t.hpp"
#include "whirl_twin/drive_state_t.hpp"
#include "whirl_twin/ensemble_state_t.hpp"
#include "whirl_twin/motor_state_t.hpp"
#include "whirl_twin/parameter_change_t.hpp"
#include "whirl_twin/pendulum_state_t.hpp"
#include "whirl_twin/stability_margin_t.hpp"
#include "whirl_twin/whirl_state_t.hpp"

namespace whirl_twin {

whirl_state_t toLcm(const state::WhirlState& whirl);
pendulum_state_t toLcm(const state::PendulumState& pendulum);
drive_state_t toLcm(const state::DriveState& drive);
motor_state_t toLcm(const state::MotorState& motor);
ensemble_state_t toLcm(const state::EnsembleState& ensemble);
stability_margin_t toLcm(const state::StabilityMargin& margin);
parameter_change_t toLcm(const state::ParameterChange& change);
alert_t toLcm(const state::Alert& alert);

state::WhirlState fromLcm(const whirl_state_t& message);
state::PendulumState fromLcm(const pendulum_state_t& message);
state::DriveState fromLcm(const drive_state_t& message);
state::MotorState fromLcm(const motor_state_t& message);
state::EnsembleState fromLcm(const ensemble_state_t& message);
state::StabilityMargin fromLcm(const stability_margin_t& message);
state::ParameterChange fromLcm(const parameter_change_t& message);
state::Alert fromLcm(const alert_t& message);

}  // namespace whirl_twin
