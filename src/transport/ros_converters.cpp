#include "transport/ros_converters.h"

#include <algorithm>
#include <string>

#include "transport/ensemble_fields.h"
#include "transport/message_fields.h"

namespace whirl_twin {
namespace {

template <class Message>
void putInstant(const state::Instant& at, const std::string& name, Message& message) {
  message.header.stamp = toRosTime(at.stamp);
  message.header.frame_id = name;
  message.step = at.step;
  message.time = at.time;
}

std::int64_t stampOf(const std_msgs::Header& header) {
  return static_cast<std::int64_t>(header.stamp.toNSec());
}

template <class Message>
state::Instant takeInstant(const Message& message) {
  requireStep(message.step);
  requireTime("time", message.time);
  return {message.step, message.time, stampOf(message.header)};
}

template <class Message>
std::string takeName(const Message& message) {
  requireName("header.frame_id", message.header.frame_id);
  return message.header.frame_id;
}

}  // namespace

ros::Time toRosTime(std::int64_t stamp) {
  constexpr std::int64_t kSecond = 1000000000;
  const std::int64_t within = std::clamp<std::int64_t>(stamp, 0, kMaxStamp);
  return {static_cast<std::uint32_t>(within / kSecond),
          static_cast<std::uint32_t>(within % kSecond)};
}

WhirlState toRos(const state::WhirlState& whirl) {
  WhirlState message;
  putInstant(whirl.at, whirl.system, message);
  putFields(whirl, message);
  return message;
}

PendulumState toRos(const state::PendulumState& pendulum) {
  PendulumState message;
  putInstant(pendulum.at, pendulum.system, message);
  putFields(pendulum, message);
  return message;
}

DriveState toRos(const state::DriveState& drive) {
  DriveState message;
  putInstant(drive.at, drive.drive, message);
  putFields(drive, message);
  return message;
}

MotorState toRos(const state::MotorState& motor) {
  MotorState message;
  putInstant(motor.at, motor.drive, message);
  putFields(motor, message);
  return message;
}

EnsembleState toRos(const state::EnsembleState& ensemble) {
  EnsembleState message;
  putInstant(ensemble.at, ensemble.system, message);
  putFields(ensemble, message);
  return message;
}

StabilityMargin toRos(const state::StabilityMargin& margin) {
  StabilityMargin message;
  putInstant(margin.at, margin.system, message);
  putFields(margin, message);
  return message;
}

ParameterChange toRos(const state::ParameterChange& change) {
  ParameterChange message;
  putInstant(change.at, change.system, message);
  putFields(change, message);
  return message;
}

AlertArray toRos(const std::vector<state::Alert>& alerts, std::int64_t stamp) {
  AlertArray message;
  message.header.stamp = toRosTime(stamp);
  for (const auto& alert : alerts) {
    putFields(alert, message.alerts.emplace_back());
  }
  return message;
}

sensor_msgs::JointState toJointState(const state::WhirlState& whirl) {
  sensor_msgs::JointState message;
  message.header.stamp = toRosTime(whirl.at.stamp);
  message.header.frame_id = whirl.system;
  message.name = {"x", "y"};
  message.position = {whirl.x, whirl.y};
  message.velocity = {whirl.x_rate, whirl.y_rate};
  return message;
}

sensor_msgs::JointState toJointState(const state::PendulumState& pendulum) {
  sensor_msgs::JointState message;
  message.header.stamp = toRosTime(pendulum.at.stamp);
  message.header.frame_id = pendulum.system;
  message.name = pendulum.name;
  message.position = pendulum.angle;
  message.velocity = pendulum.rate;
  return message;
}

state::WhirlState fromRos(const WhirlState& message) {
  state::WhirlState whirl;
  whirl.at = takeInstant(message);
  whirl.system = takeName(message);
  takeFields(message, whirl);
  return whirl;
}

state::PendulumState fromRos(const PendulumState& message) {
  state::PendulumState pendulum;
  pendulum.at = takeInstant(message);
  pendulum.system = takeName(message);
  takeFields(message, pendulum);
  return pendulum;
}

state::DriveState fromRos(const DriveState& message) {
  state::DriveState drive;
  drive.at = takeInstant(message);
  drive.drive = takeName(message);
  takeFields(message, drive);
  return drive;
}

state::MotorState fromRos(const MotorState& message) {
  state::MotorState motor;
  motor.at = takeInstant(message);
  motor.drive = takeName(message);
  takeFields(message, motor);
  return motor;
}

state::EnsembleState fromRos(const EnsembleState& message) {
  state::EnsembleState ensemble;
  ensemble.at = takeInstant(message);
  ensemble.system = takeName(message);
  takeFields(message, ensemble);
  return ensemble;
}

state::StabilityMargin fromRos(const StabilityMargin& message) {
  state::StabilityMargin margin;
  margin.at = takeInstant(message);
  margin.system = takeName(message);
  takeFields(message, margin);
  return margin;
}

state::ParameterChange fromRos(const ParameterChange& message) {
  state::ParameterChange change;
  change.at = takeInstant(message);
  change.system = takeName(message);
  takeFields(message, change);
  return change;
}

std::vector<state::Alert> fromRos(const AlertArray& message) {
  std::vector<state::Alert> alerts;
  for (const auto& alert : message.alerts) {
    takeFields(alert, alerts.emplace_back());
    alerts.back().stamp = stampOf(message.header);
  }
  return alerts;
}

}  // namespace whirl_twin
