// State <-> ROS message, one converter a direction. A header carries the stamp of the state's
// instant, and the system's or drive's name as frame_id. toRos() never fails; fromRos() throws
// RejectedMessage for a message that cannot be meant: an illegal name, arrays of different lengths,
// a number outside its range.
#pragma once

#include <ros/time.h>
#include <sensor_msgs/JointState.h>

#include <cstdint>
#include <vector>

#include "messages/alert.h"
#include "messages/message_check.h"
#include "messages/stability_margin.h"
#include "messages/states.h"
#include "whirl_twin/AlertArray.h"
#include "whirl_twin/DriveState.h"
#include "whirl_twin/EnsembleState.h"
#include "whirl_twin/MotorState.h"
#include "whirl_twin/ParameterChange.h"
#include "whirl_twin/PendulumState.h"
#include "whirl_twin/StabilityMargin.h"
#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

/// A stamp [ns] as ROS time; what ROS time cannot carry (negative, beyond 2106) becomes its end.
ros::Time toRosTime(std::int64_t stamp);

WhirlState toRos(const state::WhirlState& whirl);
PendulumState toRos(const state::PendulumState& pendulum);
DriveState toRos(const state::DriveState& drive);
MotorState toRos(const state::MotorState& motor);
EnsembleState toRos(const state::EnsembleState& ensemble);
StabilityMargin toRos(const state::StabilityMargin& margin);
ParameterChange toRos(const state::ParameterChange& change);
/// The complete list of active alerts, stamped with the instant [ns] it holds at.
AlertArray toRos(const std::vector<state::Alert>& alerts, std::int64_t stamp);

/// The same state as sensor_msgs/JointState: every coordinate's position and rate, effort empty.
/// For a rotor the coordinates are x and y of the disc centre.
sensor_msgs::JointState toJointState(const state::WhirlState& whirl);
sensor_msgs::JointState toJointState(const state::PendulumState& pendulum);

state::WhirlState fromRos(const WhirlState& message);
state::PendulumState fromRos(const PendulumState& message);
state::DriveState fromRos(const DriveState& message);
state::MotorState fromRos(const MotorState& message);
state::EnsembleState fromRos(const EnsembleState& message);
state::StabilityMargin fromRos(const StabilityMargin& message);
state::ParameterChange fromRos(const ParameterChange& message);
/// The alerts take the stamp of the list: an Alert has none of its own.
std::vector<state::Alert> fromRos(const AlertArray& message);

}  // namespace whirl_twin
