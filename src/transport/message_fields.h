// The fields that an LCM type and a ROS message of the same thing share, name for name: put from a
// state into a message, and taken from a message after asking whether they can be meant. The
// converters add what differs: stamps, names and LCM's array lengths.
#pragma once

#include <cmath>
#include <cstddef>

#include "messages/alert.h"
#include "messages/message_check.h"
#include "messages/stability_margin.h"
#include "messages/states.h"

namespace whirl_twin {

template <class Message>
void putFields(const state::WhirlState& whirl, Message& message) {
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
}

template <class Message>
void takeFields(const Message& message, state::WhirlState& whirl) {
  requireFlag("phase_valid", message.phase_valid);
  requireFlag("forward", message.forward);
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
}

template <class Message>
void putFields(const state::PendulumState& pendulum, Message& message) {
  message.name = pendulum.name;
  message.angle = pendulum.angle;
  message.rate = pendulum.rate;
  message.kinetic = pendulum.kinetic;
  message.potential = pendulum.potential;
  message.energy_residual = pendulum.energy_residual;
}

template <class Message>
void takeFields(const Message& message, state::PendulumState& pendulum) {
  requireNames("name", message.name);
  requireLength("angle", message.angle.size(), message.name.size());
  requireLength("rate", message.rate.size(), message.name.size());
  pendulum.name = message.name;
  pendulum.angle = message.angle;
  pendulum.rate = message.rate;
  pendulum.kinetic = message.kinetic;
  pendulum.potential = message.potential;
  pendulum.energy_residual = message.energy_residual;
}

template <class Message>
void putFields(const state::DriveState& drive, Message& message) {
  message.speed = drive.speed;
  message.acceleration = drive.acceleration;
  message.jerk = drive.jerk;
  message.target_speed = drive.target_speed;
  message.turns = drive.turns;
  message.remainder = drive.remainder;
  message.shaft_angle = drive.shaft_angle;
}

template <class Message>
void takeFields(const Message& message, state::DriveState& drive) {
  drive.speed = message.speed;
  drive.acceleration = message.acceleration;
  drive.jerk = message.jerk;
  drive.target_speed = message.target_speed;
  drive.turns = message.turns;
  drive.remainder = message.remainder;
  drive.shaft_angle = message.shaft_angle;
}

template <class Message>
void putFields(const state::MotorState& motor, Message& message) {
  message.system = motor.system;
  message.speed = motor.speed;
  message.acceleration = motor.acceleration;
  message.torque = motor.torque;
  message.motor_power = motor.motor_power;
  message.drag_power = motor.drag_power;
  message.dissipated_power = motor.dissipated_power;
  message.energy = motor.energy;
  message.motor_work = motor.motor_work;
  message.dissipated_work = motor.dissipated_work;
}

template <class Message>
void takeFields(const Message& message, state::MotorState& motor) {
  requireName("system", message.system);
  motor.system = message.system;
  motor.speed = message.speed;
  motor.acceleration = message.acceleration;
  motor.torque = message.torque;
  motor.motor_power = message.motor_power;
  motor.drag_power = message.drag_power;
  motor.dissipated_power = message.dissipated_power;
  motor.energy = message.energy;
  motor.motor_work = message.motor_work;
  motor.dissipated_work = message.dissipated_work;
}

template <class Message>
void putFields(const state::ParameterChange& change, Message& message) {
  message.names = change.names;
  message.values = change.values;
  message.changed = change.changed;
  message.previous = change.previous;
}

template <class Message>
void takeFields(const Message& message, state::ParameterChange& change) {
  requirePaths("names", message.names);
  requireLength("values", message.values.size(), message.names.size());
  requirePaths("changed", message.changed);
  requireLength("previous", message.previous.size(), message.changed.size());
  change.names = message.names;
  change.values = message.values;
  change.changed = message.changed;
  change.previous = message.previous;
}

template <class Message>
void putFields(const state::StabilityMargin& margin, Message& message) {
  message.model = margin.model;
  message.verdict = static_cast<decltype(message.verdict)>(margin.verdict);
  message.verdict_name = margin.verdict_name;
  message.coordinate = margin.coordinate;
  message.operating_point = margin.operating_point;
  message.speed = margin.speed;
  message.polynomial = margin.polynomial;
  message.first_column = margin.first_column;
  message.right = static_cast<decltype(message.right)>(margin.right);
  message.imaginary = static_cast<decltype(message.imaginary)>(margin.imaginary);
  message.left = static_cast<decltype(message.left)>(margin.left);
  message.decay_rate = margin.decay_rate;
  message.damping_ratio = margin.damping_ratio;
  message.log_decrement = margin.log_decrement;
  message.instability_speed = margin.instability_speed;
  message.instability_speed_valid = !std::isnan(margin.instability_speed);
  for (const auto& critical : margin.critical_speeds) {
    message.critical_speed.push_back(critical.speed);
    message.direction.push_back(critical.direction);
    message.amplification_factor.push_back(critical.amplification_factor);
    message.separation_margin.push_back(critical.separation_margin);
    message.required_separation_margin.push_back(critical.required_separation_margin);
    message.band_low.push_back(critical.band_low);
    message.band_high.push_back(critical.band_high);
  }
}

template <class Message>
void takeCriticalSpeeds(const Message& message, state::StabilityMargin& margin) {
  const std::size_t count = message.critical_speed.size();
  requireLength("direction", message.direction.size(), count);
  requireLength("amplification_factor", message.amplification_factor.size(), count);
  requireLength("separation_margin", message.separation_margin.size(), count);
  requireLength("required_separation_margin", message.required_separation_margin.size(), count);
  requireLength("band_low", message.band_low.size(), count);
  requireLength("band_high", message.band_high.size(), count);
  margin.critical_speeds.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto& critical = margin.critical_speeds[i];
    critical.speed = message.critical_speed[i];
    requireDirection(message.direction[i]);
    critical.direction = message.direction[i];
    critical.amplification_factor = message.amplification_factor[i];
    critical.separation_margin = message.separation_margin[i];
    critical.required_separation_margin = message.required_separation_margin[i];
    critical.band_low = message.band_low[i];
    critical.band_high = message.band_high[i];
  }
}

template <class Message>
void takeFields(const Message& message, state::StabilityMargin& margin) {
  requireName("model", message.model);
  requireRange("verdict", message.verdict, 0, 4);
  requireName("verdict_name", message.verdict_name);
  requireNames("coordinate", message.coordinate);
  requireLength("operating_point", message.operating_point.size(), message.coordinate.size());
  // A polynomial has one coefficient more than it has roots.
  const auto coefficients = static_cast<std::int64_t>(message.polynomial.size());
  requireRange("right", message.right, 0, coefficients);
  requireRange("imaginary", message.imaginary, 0, coefficients);
  requireRange("left", message.left, 0, coefficients);
  // NaN and false say the same thing twice: none was found.
  const int found = std::isnan(message.instability_speed) ? 0 : 1;
  requireRange("instability_speed_valid", message.instability_speed_valid, found, found);
  margin.model = message.model;
  margin.verdict = static_cast<std::uint8_t>(message.verdict);
  margin.verdict_name = message.verdict_name;
  margin.coordinate = message.coordinate;
  margin.operating_point = message.operating_point;
  margin.speed = message.speed;
  margin.polynomial = message.polynomial;
  margin.first_column = message.first_column;
  margin.right = static_cast<std::uint32_t>(message.right);
  margin.imaginary = static_cast<std::uint32_t>(message.imaginary);
  margin.left = static_cast<std::uint32_t>(message.left);
  margin.decay_rate = message.decay_rate;
  margin.damping_ratio = message.damping_ratio;
  margin.log_decrement = message.log_decrement;
  margin.instability_speed = message.instability_speed;
  takeCriticalSpeeds(message, margin);
}

template <class Message>
void putFields(const state::Alert& alert, Message& message) {
  // LCM has no unsigned integers: an id beyond 2^31 goes through as the same 32 bits.
  message.id = static_cast<decltype(message.id)>(alert.id);
  message.type = alert.type;
  message.system = alert.system;
  message.severity = static_cast<decltype(message.severity)>(alert.severity);
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
}

template <class Message>
void takeFields(const Message& message, state::Alert& alert) {
  requireName("type", message.type);
  requireName("system", message.system);
  requireRange("severity", message.severity, 0, 2);
  requireFlag("state", message.state);
  requireTime("raised_time", message.raised_time);
  requireTime("time", message.time);
  requireText("text", message.text);
  alert.id = static_cast<std::uint32_t>(message.id);
  alert.type = message.type;
  alert.system = message.system;
  alert.severity = static_cast<state::Severity>(message.severity);
  alert.raised = message.state == 0;
  alert.raised_time = message.raised_time;
  alert.time = message.time;
  alert.speed = message.speed;
  alert.acceleration = message.acceleration;
  alert.critical_speed = message.critical_speed;
  alert.time_to_entry = message.time_to_entry;
  alert.separation_margin = message.separation_margin;
  alert.required_separation_margin = message.required_separation_margin;
  alert.amplification_factor = message.amplification_factor;
  alert.decay_rate = message.decay_rate;
  alert.text = message.text;
}

}  // namespace whirl_twin
