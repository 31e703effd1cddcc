#include "transport/lcm_converters.h"

#include "transport/lcm_instant.h"

namespace whirl_twin {

whirl_state_t toLcm(const state::WhirlState& whirl) {
  whirl_state_t message;
  putInstant(whirl.at, message);
  message.system = whirl.system;
  message.radius = whirl.radius;
  message.phase = whirl.phase;
  message.phase_valid = whirl.phase_valid;
  message.whirl_angle = whirl.whirl_angle;
  message.whirl_rate = whirl.whirl_rate;
  message.speed = whirl.speed;
  message.shaft_angle = whirl.shaft_angle;
  message.x = whirl.x;
  message.y = whirl.y;
  message.x_rate = whirl.x_rate;
  message.y_rate = whirl.y_rate;
  message.orbit_major = whirl.orbit_major;
  message.orbit_minor = whirl.orbit_minor;
  message.forward = whirl.forward;
  message.energy_residual = whirl.energy_residual;
  return message;
}

state::WhirlState fromLcm(const whirl_state_t& message) {
  requireName("system", message.system);
  requireFlag("phase_valid", message.phase_valid);
  requireFlag("forward", message.forward);
  state::WhirlState whirl;
  whirl.at = takeInstant(message);
  whirl.system = message.system;
  whirl.radius = message.radius;
  whirl.phase = message.phase;
  whirl.phase_valid = message.phase_valid != 0;
  whirl.whirl_angle = message.whirl_angle;
  whirl.whirl_rate = message.whirl_rate;
  whirl.speed = message.speed;
  whirl.shaft_angle = message.shaft_angle;
  whirl.x = message.x;
  whirl.y = message.y;
  whirl.x_rate = message.x_rate;
  whirl.y_rate = message.y_rate;
  whirl.orbit_major = message.orbit_major;
  whirl.orbit_minor = message.orbit_minor;
  whirl.forward = message.forward != 0;
  whirl.energy_residual = message.energy_residual;
  return whirl;
}

pendulum_state_t toLcm(const state::PendulumState& pendulum) {
  pendulum_state_t message;
  putInstant(pendulum.at, message);
  message.system = pendulum.system;
  message.coordinates = static_cast<std::int32_t>(pendulum.name.size());
  message.name = pendulum.name;
  message.angle = pendulum.angle;
  message.rate = pendulum.rate;
  message.angle.resize(pendulum.name.size());
  message.rate.resize(pendulum.name.size());
  message.kinetic = pendulum.kinetic;
  message.potential = pendulum.potential;
  message.energy_residual = pendulum.energy_residual;
  return message;
}

state::PendulumState fromLcm(const pendulum_state_t& message) {
  requireName("system", message.system);
  requireLength("name", message.name.size(), message.coordinates);
  requireLength("angle", message.angle.size(), message.coordinates);
  requireLength("rate", message.rate.size(), message.coordinates);
  requireNames("name", message.name);
  state::PendulumState pendulum;
  pendulum.at = takeInstant(message);
  pendulum.system = message.system;
  pendulum.name = message.name;
  pendulum.angle = message.angle;
  pendulum.rate = message.rate;
  pendulum.kinetic = message.kinetic;
  pendulum.potential = message.potential;
  pendulum.energy_residual = message.energy_residual;
  return pendulum;
}

drive_state_t toLcm(const state::DriveState& drive) {
  drive_state_t message;
  putInstant(drive.at, message);
  message.drive = drive.drive;
  message.speed = drive.speed;
  message.acceleration = drive.acceleration;
  message.jerk = drive.jerk;
  message.target_speed = drive.target_speed;
  message.turns = drive.turns;
  message.remainder = drive.remainder;
  message.shaft_angle = drive.shaft_angle;
  return message;
}

state::DriveState fromLcm(const drive_state_t& message) {
  requireName("drive", message.drive);
  state::DriveState drive;
  drive.at = takeInstant(message);
  drive.drive = message.drive;
  drive.speed = message.speed;
  drive.acceleration = message.acceleration;
  drive.jerk = message.jerk;
  drive.target_speed = message.target_speed;
  drive.turns = message.turns;
  drive.remainder = message.remainder;
  drive.shaft_angle = message.shaft_angle;
  return drive;
}

alert_t toLcm(const state::Alert& alert) {
  alert_t message;
  message.utime = utimeOf(alert.time);
  message.stamp = alert.stamp;
  message.id = static_cast<std::int32_t>(alert.id);
  message.type = alert.type;
  message.system = alert.system;
  message.severity = static_cast<std::int8_t>(alert.severity);
  message.state = alert.raised ? 0 : 1;
  message.raised_time = alert.raised_time;
  message.time = alert.time;
  message.speed = alert.speed;
  message.acceleration = alert.acceleration;
  message.critical_speed = alert.critical_speed;
  message.time_to_entry = alert.time_to_entry;
  message.separation_margin = alert.separation_margin;
  message.required_separation_margin = alert.required_separation_margin;
  message.amplification_factor = alert.amplification_factor;
  message.decay_rate = alert.decay_rate;
  message.text = alert.text;
  return message;
}

state::Alert fromLcm(const alert_t& message) {
  requireName("type", message.type);
  requireName("system", message.system);
  requireText("text", message.text);
  requireRange("severity", message.severity, 0, 2);
  requireFlag("state", message.state);
  requireInstant(0, message.time, message.stamp);
  requireInstant(0, message.raised_time, message.stamp);
  requireUtime(message);
  state::Alert alert;
  alert.id = static_cast<std::uint32_t>(message.id);
  alert.type = message.type;
  alert.system = message.system;
  alert.severity = static_cast<state::Severity>(message.severity);
  alert.raised = message.state == 0;
  alert.raised_time = message.raised_time;
  alert.time = message.time;
  alert.stamp = message.stamp;
  alert.speed = message.speed;
  alert.acceleration = message.acceleration;
  alert.critical_speed = message.critical_speed;
  alert.time_to_entry = message.time_to_entry;
  alert.separation_margin = message.separation_margin;
  alert.required_separation_margin = message.required_separation_margin;
  alert.amplification_factor = message.amplification_factor;
  alert.decay_rate = message.decay_rate;
  alert.text = message.text;
  return alert;
}

}  // namespace whirl_twin
