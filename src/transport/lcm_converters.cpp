#include "transport/lcm_converters.h"

#include <fmt/format.h>

#include "transport/ensemble_fields.h"
#include "transport/message_fields.h"

namespace whirl_twin {
namespace {

template <class Message>
void putInstant(const state::Instant& at, Message& message) {
  message.utime = utimeOf(at.time);
  message.stamp = at.stamp;
  message.step = at.step;
  message.time = at.time;
}

template <class Message>
void requireUtime(const Message& message) {
  if (message.utime != utimeOf(message.time)) {
    throw RejectedMessage(fmt::format("utime: expected {} us, the time of {} s, found {}",
                                      utimeOf(message.time), message.time, message.utime));
  }
}

template <class Message>
state::Instant takeInstant(const Message& message) {
  requireStep(message.step);
  requireTime("time", message.time);
  requireStamp(message.stamp);
  requireUtime(message);
  return {message.step, message.time, message.stamp};
}

std::int32_t lengthOf(std::size_t size) {
  return static_cast<std::int32_t>(size);
}

}  // namespace

whirl_state_t toLcm(const state::WhirlState& whirl) {
  whirl_state_t message;
  putInstant(whirl.at, message);
  message.system = whirl.system;
  putFields(whirl, message);
  return message;
}

state::WhirlState fromLcm(const whirl_state_t& message) {
  requireName("system", message.system);
  state::WhirlState whirl;
  whirl.at = takeInstant(message);
  whirl.system = message.system;
  takeFields(message, whirl);
  return whirl;
}

pendulum_state_t toLcm(const state::PendulumState& pendulum) {
  pendulum_state_t message;
  putInstant(pendulum.at, message);
  message.system = pendulum.system;
  putFields(pendulum, message);
  message.coordinates = lengthOf(message.name.size());
  message.angle.resize(message.name.size());
  message.rate.resize(message.name.size());
  return message;
}

state::PendulumState fromLcm(const pendulum_state_t& message) {
  requireName("system", message.system);
  requireLength("name", message.name.size(), message.coordinates);
  state::PendulumState pendulum;
  pendulum.at = takeInstant(message);
  pendulum.system = message.system;
  takeFields(message, pendulum);
  return pendulum;
}

drive_state_t toLcm(const state::DriveState& drive) {
  drive_state_t message;
  putInstant(drive.at, message);
  message.drive = drive.drive;
  putFields(drive, message);
  return message;
}

state::DriveState fromLcm(const drive_state_t& message) {
  requireName("drive", message.drive);
  state::DriveState drive;
  drive.at = takeInstant(message);
  drive.drive = message.drive;
  takeFields(message, drive);
  return drive;
}

motor_state_t toLcm(const state::MotorState& motor) {
  motor_state_t message;
  putInstant(motor.at, message);
  message.drive = motor.drive;
  putFields(motor, message);
  return message;
}

state::MotorState fromLcm(const motor_state_t& message) {
  requireName("drive", message.drive);
  state::MotorState motor;
  motor.at = takeInstant(message);
  motor.drive = message.drive;
  takeFields(message, motor);
  return motor;
}

ensemble_state_t toLcm(const state::EnsembleState& ensemble) {
  ensemble_state_t message;
  putInstant(ensemble.at, message);
  message.system = ensemble.system;
  putFields(ensemble, message);
  const std::size_t quantities = message.quantity.size();
  message.quantities = lengthOf(quantities);
  message.unit.resize(quantities);
  eachStatistic(ensemble, message,
                [&](const char*, const auto&, auto& statistic) { statistic.resize(quantities); });
  return message;
}

state::EnsembleState fromLcm(const ensemble_state_t& message) {
  requireName("system", message.system);
  requireLength("quantity", message.quantity.size(), message.quantities);
  state::EnsembleState ensemble;
  ensemble.at = takeInstant(message);
  ensemble.system = message.system;
  takeFields(message, ensemble);
  return ensemble;
}

stability_margin_t toLcm(const state::StabilityMargin& margin) {
  stability_margin_t message;
  putInstant(margin.at, message);
  message.system = margin.system;
  putFields(margin, message);
  message.coordinates = lengthOf(message.coordinate.size());
  message.operating_point.resize(message.coordinate.size());
  message.coefficients = lengthOf(message.polynomial.size());
  message.rows = lengthOf(message.first_column.size());
  message.critical_speeds = lengthOf(message.critical_speed.size());
  return message;
}

state::StabilityMargin fromLcm(const stability_margin_t& message) {
  requireName("system", message.system);
  requireLength("coordinate", message.coordinate.size(), message.coordinates);
  requireLength("polynomial", message.polynomial.size(), message.coefficients);
  requireLength("first_column", message.first_column.size(), message.rows);
  requireLength("critical_speed", message.critical_speed.size(), message.critical_speeds);
  state::StabilityMargin margin;
  margin.at = takeInstant(message);
  margin.system = message.system;
  takeFields(message, margin);
  return margin;
}

parameter_change_t toLcm(const state::ParameterChange& change) {
  parameter_change_t message;
  putInstant(change.at, message);
  message.system = change.system;
  putFields(change, message);
  message.parameters = lengthOf(message.names.size());
  message.values.resize(message.names.size());
  message.changes = lengthOf(message.changed.size());
  message.previous.resize(message.changed.size());
  return message;
}

state::ParameterChange fromLcm(const parameter_change_t& message) {
  requireName("system", message.system);
  requireLength("names", message.names.size(), message.parameters);
  requireLength("changed", message.changed.size(), message.changes);
  state::ParameterChange change;
  change.at = takeInstant(message);
  change.system = message.system;
  takeFields(message, change);
  return change;
}

alert_t toLcm(const state::Alert& alert) {
  alert_t message;
  message.utime = utimeOf(alert.time);
  message.stamp = alert.stamp;
  putFields(alert, message);
  return message;
}

state::Alert fromLcm(const alert_t& message) {
  state::Alert alert;
  takeFields(message, alert);
  requireUtime(message);
  requireStamp(message.stamp);
  alert.stamp = message.stamp;
  return alert;
}

}  // namespace whirl_twin
