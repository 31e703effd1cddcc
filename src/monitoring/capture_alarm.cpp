#include "monitoring/capture_alarm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "messages/alert.h"

namespace whirl_twin {
namespace {

constexpr double kStill = 0.005;   // of the critical speed, that it may change by meanwhile
constexpr double kStillFor = 1.5;  // s
constexpr double kNear = 0.1;      // of the critical speed, from where it is to hang

}  // namespace

CaptureAlarm::CaptureAlarm(std::string system, const AlarmSettings& settings)
    : system_(std::move(system)),
      settings_(settings),
      alarm_(settings.delaysOf(alert_type::kSommerfeldCapture)) {}

void CaptureAlarm::set(const AlarmSettings& settings) {
  settings_ = settings;
  alarm_.setDelays(settings.delaysOf(alert_type::kSommerfeldCapture));
}

bool CaptureAlarm::standsStill(double time, double speed, double scale) {
  if (!stands_ || time < stood_since_ || std::abs(speed - stood_at_) > kStill * scale) {
    stands_ = true;
    stood_since_ = time;
    stood_at_ = speed;
  }
  return time - stood_since_ >= kStillFor;
}

void CaptureAlarm::update(const state::DriveState& shaft, const std::vector<CaptureSpeed>& captures,
                          AlertList& alerts) {
  const double time = shaft.at.time;
  const double speed = shaft.speed;
  if (!std::isfinite(speed) || !std::isfinite(time)) {
    alarm_.update(time, AlarmCondition::kHold);
    return;
  }
  // What is behind it, by more than the hysteresis, holds it no more.
  const auto ahead = std::find_if(captures.begin(), captures.end(), [&](const CaptureSpeed& c) {
    return speed <= (1.0 + settings_.hysteresis) * c.band.to;
  });
  AlarmCondition condition = AlarmCondition::kClear;
  if (ahead != captures.end()) {
    const bool still = standsStill(time, speed, ahead->critical_speed);
    const bool near = std::abs(speed - ahead->speed) <= kNear * ahead->critical_speed;
    condition = speed > ahead->escape ? AlarmCondition::kHold : AlarmCondition::kWarning;
    condition = still && near ? AlarmCondition::kDanger : condition;
  }
  if (alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(
        system_, alert_type::kSommerfeldCapture, time,
        fmt::format("{}: the resonance was passed, speed {}", system_, shaftSpeedText(speed)));
  } else if (alarm_.active() && isRaising(condition)) {
    state::Alert alert;
    alert.type = alert_type::kSommerfeldCapture;
    alert.system = system_;
    alert.severity = alarm_.severity();
    alert.time = time;
    alert.speed = speed;
    alert.acceleration = shaft.acceleration;
    alert.critical_speed = ahead->critical_speed;
    const std::string where = "critical speed " + shaftSpeedText(ahead->critical_speed);
    const bool danger = alarm_.severity() == state::Severity::kDanger;
    alert.text = danger ? fmt::format(
                              "{}: resonance capture near {} by {}: the whirl absorbs all the "
                              "motor's torque: switch the motor off or raise its torque",
                              system_, shaftSpeedText(ahead->speed), where)
                        : fmt::format(
                              "{}: the motor has less torque than {} needs, resonance capture at "
                              "{} expected: stay below {} or raise the torque",
                              system_, where, shaftSpeedText(ahead->speed),
                              shaftSpeedText(ahead->band.from));
    alerts.raise(std::move(alert), fmt::format("capture {}", ahead - captures.begin()));
  }
}

}  // namespace whirl_twin
