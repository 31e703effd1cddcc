#include "monitoring/order_alarm.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "algebra/constants.h"
#include "messages/alert.h"

namespace whirl_twin {

namespace {

constexpr double kSubsynchronous = 0.95;  // of the speed, below which a line is
constexpr double kBeside = 0.01;          // of the speed, that a subharmonic may be off
constexpr double kMicrometre = 1.0e6;     // per metre
constexpr double kNoLevel = kInfinity;

/// The highest forward line slower than the shaft; -1: none.
int subsynchronousLine(const state::OrderState& orders) {
  for (std::size_t i = 0; i < orders.line_frequency.size(); ++i) {  // largest first
    if (orders.line_ratio[i] < kSubsynchronous &&
        orders.line_forward[i] > orders.line_backward[i]) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

AlarmCondition levelCondition(double value, double warning, double danger, double hysteresis) {
  if (std::isnan(value)) {
    return AlarmCondition::kHold;
  }
  return value > danger                          ? AlarmCondition::kDanger
         : value > warning                       ? AlarmCondition::kWarning
         : value <= warning * (1.0 - hysteresis) ? AlarmCondition::kClear
                                                 : AlarmCondition::kHold;
}

/// Amplitude [m] of what turns against the rotation. Of a motion f e^(iwt) + b e^(-iwt) half the
/// peak to peak is f + b, and the precession 1 - (b/f)^2 or (f/b)^2 - 1, short of b^4 / (4 f^4).
double backwardPart(const state::OrderState& orders) {
  const double smaller = std::sqrt(std::fmax(0.0, 1.0 - std::fabs(orders.precession)));
  const double larger_part = 0.5 * orders.peak_to_peak / (1.0 + smaller);
  return orders.precession < 0.0 ? larger_part : smaller * larger_part;
}

/// The highest line at a half or a third of the speed; -1: none.
int subharmonicLine(const state::OrderState& orders) {
  for (std::size_t i = 0; i < orders.line_frequency.size(); ++i) {  // largest first
    for (const double part : {1.0 / 2.0, 1.0 / 3.0}) {
      if (std::fabs(orders.line_ratio[i] - part) < kBeside) {
        return static_cast<int>(i);
      }
    }
  }
  return -1;
}

const char* lineAdvice(LineCharacter::Kind kind) {
  switch (kind) {
    case LineCharacter::Kind::kKeepsRatio:
      return "it keeps its ratio to the speed: oil whirl; check the bearings, their load and oil";
    case LineCharacter::Kind::kKeepsFrequency:
      return "it keeps its frequency: oil whip; reduce the speed below its onset";
    default:
      return "reduce the speed, and check whether it keeps its ratio (oil whirl) or its frequency "
             "(oil whip)";
  }
}

}  // namespace

OrderAlarm::OrderAlarm(std::string system, const AlarmSettings& settings)
    : system_(std::move(system)),
      start_up_(settings),
      zone_alarm_(settings.delaysOf(alert_type::kVibrationZone)),
      line_alarm_(settings.delaysOf(alert_type::kSubsynchronousWhirl)),
      rub_alarm_(settings.delaysOf(alert_type::kRub)) {
  set(settings);
}

void OrderAlarm::set(const AlarmSettings& settings) {
  hysteresis_ = settings.hysteresis;
  start_up_.set(settings);
  zone_alarm_.setDelays(settings.delaysOf(alert_type::kVibrationZone));
  line_alarm_.setDelays(settings.delaysOf(alert_type::kSubsynchronousWhirl));
  const auto zones = settings.zones.find(system_);
  has_zones_ = zones != settings.zones.end();
  zones_ = has_zones_ ? zones->second : VibrationZones{kNoLevel, kNoLevel, kNoLevel};
  const auto level = settings.subsynchronous.find(system_);
  line_level_ = level != settings.subsynchronous.end() ? level->second : kNoLevel;
  rub_alarm_.setDelays(settings.delaysOf(alert_type::kRub));
  const auto rub = settings.rub.find(system_);
  rub_levels_ = rub != settings.rub.end() ? rub->second : RubLevels();
}

void OrderAlarm::hold() {
  zone_alarm_.hold();
  line_alarm_.hold();
  rub_alarm_.hold();
}

void OrderAlarm::update(const state::OrderState& orders, double acceleration, AlertList& alerts) {
  // Without levels an alarm can only clear.
  if (has_zones_ || zone_alarm_.active()) {
    updateZone(orders, acceleration, alerts);
  }
  if (std::isfinite(line_level_) || line_alarm_.active()) {
    updateLine(orders, alerts);
  }
  if (std::isfinite(rub_levels_.backward) || std::isfinite(rub_levels_.subharmonic) ||
      rub_alarm_.active()) {
    updateRub(orders, alerts);
  }
}

void OrderAlarm::updateZone(const state::OrderState& orders, double acceleration,
                            AlertList& alerts) {
  const double time = orders.at.time;
  const double by = start_up_.multiplier(time, orders.speed, acceleration);
  const double vibration = orders.peak_to_peak;
  const AlarmCondition condition =
      levelCondition(vibration, by * zones_.b, by * zones_.c, hysteresis_);
  if (zone_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kVibrationZone, time,
                 fmt::format("{}: vibration back to {:.3g} um peak-to-peak, {}", system_,
                             kMicrometre * vibration,
                             !has_zones_            ? "its zones are no longer set"
                             : vibration > zones_.a ? "zone B"
                                                    : "zone A"));
  } else if (zone_alarm_.active() && isRaising(condition)) {
    const bool danger = condition == AlarmCondition::kDanger;
    state::Alert alert;
    alert.system = system_;
    alert.type = alert_type::kVibrationZone;
    alert.severity = zone_alarm_.severity();
    alert.time = time;
    alert.speed = orders.speed;
    alert.acceleration = acceleration;
    alert.amplitude = vibration;
    alert.amplitude_limit = by * (danger ? zones_.c : zones_.b);
    alert.text = fmt::format(
        "{}: vibration {:.3g} um peak-to-peak at {}, zone {}, above {:.3g} um{}: {}", system_,
        kMicrometre * vibration, shaftSpeedText(orders.speed), danger ? 'D' : 'C',
        kMicrometre * alert.amplitude_limit,
        by != 1.0 ? fmt::format(" (multiplied by {:g} during start-up)", by) : "",
        danger ? "stop the machine, damage is possible" : "limit the duration and find the cause");
    alerts.raise(std::move(alert), danger ? "D" : "C");
  }
}

void OrderAlarm::updateLine(const state::OrderState& orders, AlertList& alerts) {
  const double time = orders.at.time;
  const int found = orders.valid ? subsynchronousLine(orders) : -1;
  const auto line = static_cast<std::size_t>(found);
  const double height = found < 0 ? 0.0 : orders.line_forward[line] + orders.line_backward[line];
  if (found < 0) {
    line_.clear();
  } else {
    line_.take(orders.line_frequency[line], orders.speed);
  }
  // Without orders nothing can be said of what is slower than the shaft.
  const AlarmCondition condition = !orders.valid
                                       ? AlarmCondition::kHold
                                       : levelCondition(height, line_level_, kNoLevel, hysteresis_);
  if (line_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kSubsynchronousWhirl, time,
                 fmt::format("{}: subsynchronous whirl back to {:.3g} um 0-peak", system_,
                             kMicrometre * height));
  } else if (line_alarm_.active() && isRaising(condition)) {
    state::Alert alert;
    alert.system = system_;
    alert.type = alert_type::kSubsynchronousWhirl;
    alert.severity = line_alarm_.severity();
    alert.time = time;
    alert.speed = orders.speed;
    alert.amplitude = height;
    alert.amplitude_limit = line_level_;
    alert.decay_rate = -orders.line_growth[line];
    alert.text = fmt::format(
        "{}: subsynchronous forward whirl at {:.1f} rad/s, {:.2f} times the speed {}, {:.3g} um "
        "0-peak, above {:.3g} um; {}",
        system_, orders.line_frequency[line], orders.line_ratio[line], shaftSpeedText(orders.speed),
        kMicrometre * height, kMicrometre * line_level_, lineAdvice(line_.kind()));
    alerts.raise(std::move(alert), lineAdvice(line_.kind()));
  }
}

void OrderAlarm::updateRub(const state::OrderState& orders, AlertList& alerts) {
  const double time = orders.at.time;
  const double backward = backwardPart(orders);
  const int found = orders.valid ? subharmonicLine(orders) : -1;
  const auto line = static_cast<std::size_t>(found);
  const double subharmonic =
      found < 0 ? 0.0 : orders.line_forward[line] + orders.line_backward[line];
  const double backward_part = backward / rub_levels_.backward;
  const double subharmonic_part = subharmonic / rub_levels_.subharmonic;
  const bool reversed = orders.precession < 0.0 && backward_part > 1.0;
  // A motion that cannot be told (not a number) holds.
  const AlarmCondition condition =
      std::isnan(backward) ? AlarmCondition::kHold
                           : levelCondition(std::fmax(backward_part, subharmonic_part), 1.0,
                                            reversed ? 1.0 : kNoLevel, hysteresis_);
  if (rub_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kRub, time,
                 fmt::format("{}: backward whirl {:.3g} um 0-peak, no sign of a rub", system_,
                             kMicrometre * backward));
    return;
  }
  if (!rub_alarm_.active() || !isRaising(condition)) {
    return;
  }
  const bool by_backward = backward_part >= subharmonic_part;
  state::Alert alert;
  alert.system = system_;
  alert.type = alert_type::kRub;
  alert.severity = rub_alarm_.severity();
  alert.time = time;
  alert.speed = orders.speed;
  alert.amplitude = by_backward ? backward : subharmonic;
  alert.amplitude_limit = by_backward ? rub_levels_.backward : rub_levels_.subharmonic;
  const std::string what =
      by_backward ? fmt::format("backward whirl {:.3g} um 0-peak", kMicrometre * backward)
                  : fmt::format("whirl at {:.3f} times the speed, {:.3g} um 0-peak",
                                orders.line_ratio[line], kMicrometre * subharmonic);
  alert.text = fmt::format("{}: {} at {}, precession {:.2f}, above {:.3g} um: {}", system_, what,
                           shaftSpeedText(orders.speed), orders.precession,
                           kMicrometre * alert.amplitude_limit,
                           reversed ? "the rotor rolls on its stator, stop the machine"
                                    : "rub possible; check seals and clearances");
  alerts.raise(std::move(alert), reversed ? "reversed" : by_backward ? "backward" : "subharmonic");
}

}  // namespace whirl_twin
