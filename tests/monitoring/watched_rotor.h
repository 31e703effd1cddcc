// A rotor on a test bed: its drive ramps, a critical-speed alarm watches it, and every event is
// kept. Its critical speed is 100 rad/s, the band to avoid 80..120 rad/s unless others are given.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "messages/alert.h"
#include "monitoring/resonance_alarms.h"

namespace whirl_twin {

inline constexpr const char* kApproach = alert_type::kCriticalSpeedApproach;
inline constexpr const char* kInBand = alert_type::kInCriticalBand;

inline constexpr double kStep = 0.001;  // [s]

inline state::CriticalSpeedMargin criticalAt(double speed, double low, double high) {
  state::CriticalSpeedMargin critical;
  critical.speed = speed;
  critical.direction = "forward";
  critical.amplification_factor = 10.0;
  critical.band_low = low;
  critical.band_high = high;
  return critical;
}

// A rotor under its alarm, and everything the list published of it.
class WatchedRotor {
 public:
  explicit WatchedRotor(
      std::vector<state::CriticalSpeedMargin> critical_speeds = {criticalAt(100.0, 80.0, 120.0)},
      const AlarmSettings& settings = {})
      : critical_speeds_(std::move(critical_speeds)), alarm_("rotor", settings) {}

  // From the present speed to target at a constant acceleration [rad/s^2], then at target for
  // dwell [s]. noise: what the speed pick-up adds [rad/s].
  void move(
      double target, double acceleration, double dwell = 0.0,
      const std::function<double()>& noise = [] { return 0.0; }) {
    const double rate = std::copysign(acceleration, target - speed_);
    const int ramp_steps = static_cast<int>(std::lround((target - speed_) / rate / kStep));
    const int steps = ramp_steps + static_cast<int>(std::lround(dwell / kStep));
    const double from = speed_;
    for (int step = 1; step <= steps; ++step) {
      const bool ramping = step < ramp_steps;
      speed_ = ramping ? from + rate * step * kStep : target;
      see(speed_ + noise(), ramping ? rate : 0.0, target);
    }
  }

  void see(double speed, double acceleration, double target) {
    time_ += kStep;
    state::DriveState shaft;
    shaft.at.time = time_;
    shaft.speed = speed;
    shaft.acceleration = acceleration;
    shaft.target_speed = target;
    alarm_.update(shaft, critical_speeds_, list);
    for (const state::Alert& event : list.takeEvents()) {
      events.push_back(event);
    }
  }

  int count(const char* type, bool raised) const {
    return static_cast<int>(std::count_if(events.begin(), events.end(), [&](const auto& event) {
      return event.type == type && event.raised == raised;
    }));
  }

  // The nth event of a kind; a failed test when there is none.
  state::Alert event(const char* type, bool raised, int nth = 0) const {
    for (const state::Alert& event : events) {
      if (event.type == type && event.raised == raised && nth-- == 0) {
        return event;
      }
    }
    ADD_FAILURE() << "no " << type << (raised ? " raised" : " cleared");
    return {};
  }

  AlertList list;
  std::vector<state::Alert> events;

 private:
  std::vector<state::CriticalSpeedMargin> critical_speeds_;
  CriticalSpeedAlarm alarm_;
  double time_ = 0.0;
  double speed_ = 0.0;
};

}  // namespace whirl_twin
