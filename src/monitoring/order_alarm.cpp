#include <fmt/format.h>

#include <cmath>
#include <string>

#include "algebra/constants.h"
#include "messages/alert.h"
#include "monitoring/vibration_alarms.h"

namespace whirl_twin {

namespace {

constexpr double kSubsynchronous = 0.95;  // of the speed, below which a line is
constexpr double kConcurrent = 0.01;      // of the speed, that a subharmonic may be off
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
      if (std::fabs(orders.line_ratio[i] - part) < kConcurrent) {
        return static_cast<int>(i);
      }
    }
  }
  return -1;
}

/// [m], of both senses; 0 of no line.
double heightOf(const state::OrderState& orders, int line) {
  const auto i = static_cast<std::size_t>(line);
  return line < 0 ? 0.0 : orders.line_forward[i] + orders.line_backward[i];
}

const char* lineAdvice(WhirlComponentClass::Kind kind) {
  switch (kind) {
    case WhirlComponentClass::Kind::kKeepsRatio:
      return "it keeps its ratio to the speed: oil whirl; check the bearings, their load and oil";
    case WhirlComponentClass::Kind::kKeepsFrequency:
      return "it keeps its frequency: oil whip; reduce the speed below its onset";
    default:
      return "reduce the speed, and check whether it keeps its ratio (oil whirl) or its frequency "
             "(oil whip)";
  }
}

}  // namespace

OrderAlarm::OrderAlarm(const std::string& system, const SharedSettings& settings)
    : start_up_(settings),
      zone_alarm_(system, alert_type::kVibrationZone, settings),
      line_alarm_(system, alert_type::kSubsynchronousWhirl, settings),
      rub_alarm_(system, alert_type::kRub, settings) {}

void OrderAlarm::hold() {
  zone_alarm_.hold();
  line_alarm_.hold();
  rub_alarm_.hold();
}

void OrderAlarm::update(const state::OrderState& orders, double acceleration, AlertList& alerts) {
  // Without levels an alarm can only clear.
  const AlarmSettings& settings = zone_alarm_.settings();
  const std::string& system = zone_alarm_.subject();
  if (settings.zones.count(system) > 0 || zone_alarm_.active()) {
    updateZone(orders, acceleration, alerts);
  }
  if (settings.subsynchronous.count(system) > 0 || line_alarm_.active()) {
    updateLine(orders, alerts);
  }
  if (settings.rub.count(system) > 0 || rub_alarm_.active()) {
    updateRub(orders, alerts);
  }
}

void OrderAlarm::updateZone(const state::OrderState& orders, double acceleration,
                            AlertList& alerts) {
  const AlarmSettings& settings = zone_alarm_.settings();
  const VibrationZones* const given = settingOf(settings.zones, zone_alarm_.subject());
  const VibrationZones zones =
      given != nullptr ? *given : VibrationZones{kNoLevel, kNoLevel, kNoLevel};
  const double by = start_up_.multiplier(orders.at.time, orders.speed, acceleration);
  const double vibration = orders.peak_to_peak;
  const AlarmCondition condition =
      levelCondition(vibration, by * zones.b, by * zones.c, settings.hysteresis);
  zone_alarm_.update(
      orders.at.time, condition, alerts,
      [&](state::Alert& alert) {
        const bool danger = condition == AlarmCondition::kDanger;
        alert.speed = orders.speed;
        alert.acceleration = acceleration;
        alert.amplitude = vibration;
        alert.amplitude_limit = by * (danger ? zones.c : zones.b);
        alert.text =
            fmt::format("vibration {:.3g} um peak-to-peak at {}, zone {}, above {:.3g} um{}: {}",
                        kMicrometre * vibration, shaftSpeedText(orders.speed), danger ? 'D' : 'C',
                        kMicrometre * alert.amplitude_limit,
                        by != 1.0 ? fmt::format(" (multiplied by {:g} during start-up)", by) : "",
                        danger ? "stop the machine, damage is possible"
                               : "limit the duration and find the cause");
        return danger ? "D" : "C";
      },
      [&] {
        return fmt::format("vibration back to {:.3g} um peak-to-peak, {}", kMicrometre * vibration,
                           given == nullptr      ? "its zones are no longer set"
                           : vibration > zones.a ? "zone B"
                                                 : "zone A");
      });
}

void OrderAlarm::updateLine(const state::OrderState& orders, AlertList& alerts) {
  const int found = orders.valid ? subsynchronousLine(orders) : -1;
  const auto line = static_cast<std::size_t>(found);
  const double height = heightOf(orders, found);
  const AlarmSettings& settings = line_alarm_.settings();
  const double* const given = settingOf(settings.subsynchronous, line_alarm_.subject());
  const double level = given != nullptr ? *given : kNoLevel;
  if (found < 0) {
    line_.clear();
  } else {
    line_.take(orders.line_frequency[line], orders.speed);
  }
  // Without orders nothing is known of what is slower than the shaft.
  const AlarmCondition condition =
      !orders.valid ? AlarmCondition::kHold
                    : levelCondition(height, level, kNoLevel, settings.hysteresis);
  line_alarm_.update(
      orders.at.time, condition, alerts,
      [&](state::Alert& alert) {
        alert.speed = orders.speed;
        alert.amplitude = height;
        alert.amplitude_limit = level;
        alert.decay_rate = -orders.line_growth[line];
        alert.text = fmt::format(
            "subsynchronous forward whirl at {:.1f} rad/s, {:.2f} times the speed {}, {:.3g} "
            "um 0-peak, above {:.3g} um; {}",
            orders.line_frequency[line], orders.line_ratio[line], shaftSpeedText(orders.speed),
            kMicrometre * height, kMicrometre * level, lineAdvice(line_.kind()));
        return lineAdvice(line_.kind());
      },
      [&] {
        return fmt::format("subsynchronous whirl back to {:.3g} um 0-peak", kMicrometre * height);
      });
}

void OrderAlarm::updateRub(const state::OrderState& orders, AlertList& alerts) {
  const AlarmSettings& settings = rub_alarm_.settings();
  const RubLevels* const given = settingOf(settings.rub, rub_alarm_.subject());
  const RubLevels levels = given != nullptr ? *given : RubLevels();
  const double backward = backwardPart(orders);
  const int line = orders.valid ? subharmonicLine(orders) : -1;
  const double subharmonic = heightOf(orders, line);
  const double backward_part = backward / levels.backward;
  const double subharmonic_part = subharmonic / levels.subharmonic;
  const bool reversed = orders.precession < 0.0 && backward_part > 1.0;
  // A motion that is unknown (not a number) holds.
  const AlarmCondition condition =
      std::isnan(backward) ? AlarmCondition::kHold
                           : levelCondition(std::fmax(backward_part, subharmonic_part), 1.0,
                                            reversed ? 1.0 : kNoLevel, settings.hysteresis);
  rub_alarm_.update(
      orders.at.time, condition, alerts,
      [&](state::Alert& alert) {
        const bool by_backward = backward_part >= subharmonic_part;
        alert.speed = orders.speed;
        alert.amplitude = by_backward ? backward : subharmonic;
        alert.amplitude_limit = by_backward ? levels.backward : levels.subharmonic;
        const std::string what =
            by_backward ? fmt::format("backward whirl {:.3g} um 0-peak", kMicrometre * backward)
                        : fmt::format("whirl at {:.3f} times the speed, {:.3g} um 0-peak",
                                      orders.line_ratio[static_cast<std::size_t>(line)],
                                      kMicrometre * subharmonic);
        alert.text = fmt::format("{} at {}, precession {:.2f}, above {:.3g} um: {}", what,
                                 shaftSpeedText(orders.speed), orders.precession,
                                 kMicrometre * alert.amplitude_limit,
                                 reversed ? "the rotor rolls on its stator, stop the machine"
                                          : "rub possible; check seals and clearances");
        return reversed ? "reversed" : by_backward ? "backward" : "subharmonic";
      },
      [&] {
        return fmt::format("backward whirl {:.3g} um 0-peak, no sign of a rub",
                           kMicrometre * backward);
      });
}

}  // namespace whirl_twin
