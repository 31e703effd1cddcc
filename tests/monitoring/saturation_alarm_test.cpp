// What an actuator could not give, and for how long.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "messages/alert.h"
#include "monitoring/controller_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace saturation_alarm_test {

/// A mass on a spring of 1 N/m, brought to a set-point by no more than 1 N.
Scene held(double setpoint) {
  return sceneOf(fmt::format(
      "{{step: 0.001, systems: {{s: {{model: linear_system, parameters: {{names: [x], mass: "
      "[[1.0]], stiffness: [[1.0]], damping: [[0.5]]}}}}}}, controllers: {{hold: {{type: pid, "
      "rate: "
      "100.0, measures: [s.x], acts_on: [s.force_x], delay: 0.01, actuator: {{limit: 1.0}}, "
      "parameters: {{kp: 20.0, ki: 0.0, kd: 3.0, setpoint: {}}}}}}}}}",
      setpoint));
}

state::ControllerState published(double time, std::int64_t samples, std::int64_t saturated) {
  state::ControllerState state;
  state.at.time = time;
  state.controller = "hold";
  state.output = {0.0, 0.0};
  state.samples = samples;
  state.saturated = saturated;
  state.missed = samples / 4;
  return state;
}

TEST(SaturationAlarm, WarnsAfterTheTimeAllowedAndClears) {
  AlarmSettings settings;
  settings.saturation_time = 3.0;
  AlertList list;
  ControllerAlarms alarm(controllerNamed("hold"), settings);
  EXPECT_TRUE(std::isnan(alarm.saturated()));
  std::int64_t saturated = 0;
  double raised_at = 0.0, cleared_at = 0.0;
  for (int i = 0; i <= 1200; ++i) {  // 100 samples a second of two outputs, from 2 s to 7 s 80 %
    const double time = 0.01 * i;
    saturated += i > 200 && i <= 700 && i % 5 != 0 ? 2 : 0;
    alarm.update(published(time, i, saturated), list);
    if (i == 650) {
      EXPECT_NEAR(alarm.saturated(), 0.8, 1e-12);
      EXPECT_NEAR(alarm.missed(), 0.25, 1e-12);
    }
    const bool active = !list.active().empty();
    raised_at = active && raised_at == 0.0 ? time : raised_at;
    cleared_at = !active && raised_at > 0.0 && cleared_at == 0.0 ? time : cleared_at;
  }
  EXPECT_NEAR(raised_at, 5.0, 0.02);
  EXPECT_NEAR(cleared_at, 9.0, 0.02);  // the second after 7 s without, and clear_delay
}

TEST(SaturationAlarm, ShorterThanAllowedIsNone) {
  AlarmSettings settings;
  settings.saturation_time = 3.0;
  AlertList list;
  ControllerAlarms alarm(controllerNamed("hold"), settings);
  std::int64_t saturated = 0;
  for (int i = 0; i <= 1000; ++i) {
    saturated += i > 200 && i <= 400 ? 2 : 0;
    alarm.update(published(0.01 * i, i, saturated), list);
    EXPECT_TRUE(list.active().empty());
  }
}

TEST(SaturationAlarm, ATimeThatBeginsAnewIsNoNews) {
  AlertList list;
  ControllerAlarms alarm(controllerNamed("hold"), AlarmSettings{});
  alarm.update(published(50.0, 5000, 10000), list);
  alarm.update(published(0.0, 0, 0), list);
  alarm.update(published(1.0, 100, 20), list);
  EXPECT_NEAR(alarm.saturated(), 0.1, 1e-12);
}

TEST(SaturationAlarm, IsToldLiveBesideTheMargins) {
  // 0.2 m take a fifth of what there is, 3 m three times as much.
  AlarmSettings settings;
  settings.saturation_time = 2.0;
  for (const double setpoint : {0.2, 3.0}) {
    WatchedTwin live(held(setpoint), settings);
    live.run(6.0);
    const bool beyond = setpoint > 1.0;
    EXPECT_NEAR(live.loop_margins.back().saturated, beyond ? 1.0 : 0.0, 0.01);
    EXPECT_EQ(live.count(alert_type::kActuatorSaturated, true), beyond ? 1u : 0u);
  }
}

}  // namespace saturation_alarm_test
}  // namespace whirl_twin
