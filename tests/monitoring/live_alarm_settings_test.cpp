// Settings changed while the monitor runs: checked like the file, whole or not at all, and the
// alarms keep their state.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "messages/alert.h"
#include "monitoring/alarm_settings_reader.h"
#include "scene/scene_error.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace live_alarm_settings_test {

LiveAlarmSettings settingsOf(const std::string& text) {
  return LiveAlarmSettings(YAML::Load(text), "monitor.yaml", {"rotor", "pump"}, {"lcm_url"});
}

std::vector<std::string> errorsOf(LiveAlarmSettings& settings, const std::string& text) {
  try {
    settings.change(text);
  } catch (const SceneError& error) {
    return error.errors();
  } catch (const InputError& inputError) {
    return {inputError.what()};
  }
  return {};
}

TEST(LiveAlarmSettings, AChangeTakesThePlaceOfWhatItNamesAndLeavesTheRest) {
  LiveAlarmSettings live = settingsOf(R"(
lcm_url: ""
clear_delay: 1.5
delays: {UNSTABLE: {set: 0.5}}
amplitude:
  rotor: {alert: 1.0e-3, danger: 2.0e-3}
  pump: {alert: 3.0e-3}
)");
  live.change("{latch: all, amplitude: {rotor: {alert: 0.5e-3}}, delays: {LOW_DAMPING: {set: 4}}}");
  EXPECT_EQ(live.settings().latch, Latch::kAll);
  EXPECT_EQ(live.settings().clear_delay, 1.5);
  EXPECT_EQ(live.settings().amplitude.at("rotor").alert, std::vector<double>{0.5e-3});
  EXPECT_TRUE(live.settings().amplitude.at("rotor").danger.empty()) << "one setting: all of it";
  EXPECT_EQ(live.settings().amplitude.at("pump").alert, std::vector<double>{3.0e-3});
  EXPECT_EQ(live.settings().delaysOf(alert_type::kUnstable).set, 0.5);
  EXPECT_EQ(live.settings().delaysOf(alert_type::kLowDamping).set, 4.0);
  live.change("{clear_delay: ~, amplitude: {rotor: ~, pump: ~}}");
  EXPECT_EQ(live.settings().clear_delay, 1.0) << "the default";
  EXPECT_TRUE(live.settings().amplitude.empty());
  EXPECT_EQ(settingsOf(live.text()).settings().latch, Latch::kAll) << live.text();
}

TEST(LiveAlarmSettings, AllThatIsWrongIsSaidAtOnceAndNothingChanges) {
  LiveAlarmSettings live = settingsOf("{clear_delay: 1.5, amplitude: {rotor: {alert: 1.0e-3}}}");
  const std::string before = live.text();
  const std::vector<std::string> errors = errorsOf(live, R"(
latch: all
clear_delay: -1
lcm_url: x
trip_multiply: ~
amplitude:
  rotor: {alert: 2.0e-3, danger: 1.0e-3}
  pumpe: {alert: 1.0e-3}
)");
  const std::vector<std::string> expected{
      "trip_multiply: must be a setting in force to be removed, found none",
      "lcm_url: unknown parameter", "clear_delay: must be >= 0 s, found -1",
      "amplitude.rotor.danger: must be above alert, 0.002 m, found 0.001",
      "amplitude.pumpe: unknown rotor of the scene; did you mean 'pump'?"};
  EXPECT_EQ(errors.size(), expected.size());
  for (const std::string& text : expected) {
    EXPECT_TRUE(std::any_of(errors.begin(), errors.end(), [&](const std::string& error) {
      return error.find("settings: " + text) == 0;
    })) << text;
  }
  EXPECT_EQ(live.text(), before);
  EXPECT_EQ(live.settings().latch, Latch::kNone);
  EXPECT_EQ(live.settings().clear_delay, 1.5);
}

TEST(LiveAlarmSettings, WhatIsNoMapOfSettingsIsRefused) {
  LiveAlarmSettings live = settingsOf("{}");
  for (const std::string text :
       {"[1, 2]", "latch", "{latch: all, latch: none}", "{latch: ", "~", "{? [1] : 2}",
        "amplitude: &a {rotor: *a}", "delays: &a [*a, *a]"}) {
    EXPECT_FALSE(errorsOf(live, text).empty()) << text;
  }
  EXPECT_FALSE(errorsOf(live, "a: " + std::string(100000, 'b')).empty());
  EXPECT_TRUE(live.settings().amplitude.empty());
}

constexpr char kCalm[] = R"(
name: calm
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, speed: 50.0}
)";

/// A monitor that receives a whirl [m] for a while, and settings.
struct Published {
  explicit Published(
      const std::string& text = "{amplitude: {rotor: {alert: 1.0e-3, danger: 5.0e-3}}}")
      : live(YAML::Load(text), "monitor.yaml", {"rotor"}),
        monitor(build(sceneOf(kCalm)), live.settings()) {}
  void tell(double radius, double duration) {
    for (const double end = time + duration; time < end - 1.0e-9; time += 0.002) {
      monitor.take(circularWhirl("rotor", time, radius, 50.0), time);
      monitor.tick(time, false);
    }
  }
  void change(const std::string& text) {
    live.change(text);
    monitor.set(live.settings());
  }
  const state::Alert* alert() { return monitor.alerts().find("rotor", "WHIRL_AMPLITUDE"); }

  LiveAlarmSettings live;
  TwinMonitor monitor;
  double time = 0.0;  ///< [s], simulated and wall
};

TEST(LiveAlarmSettings, ALoweredLevelRaisesAndOneThatIsLiftedClearsAfterItsDelay) {
  Published published;
  published.tell(0.8e-3, 1.0);
  EXPECT_EQ(published.alert(), nullptr);
  published.change("{amplitude: {rotor: {alert: 0.5e-3}}}");
  published.tell(0.8e-3, 0.3);
  ASSERT_NE(published.alert(), nullptr);
  EXPECT_EQ(published.alert()->amplitude_limit, 0.5e-3);
  published.change("{amplitude: {rotor: {alert: 1.0e-3}}}");
  published.tell(0.8e-3, 0.9);
  EXPECT_NE(published.alert(), nullptr) << "the clear delay";
  published.tell(0.8e-3, 0.5);
  EXPECT_EQ(published.alert(), nullptr);
}

TEST(LiveAlarmSettings, AnAlertWhoseLevelIsTakenAwayClears) {
  Published published;
  published.tell(2.0e-3, 0.3);
  ASSERT_NE(published.alert(), nullptr);
  published.change("{amplitude: ~}");
  published.tell(2.0e-3, 1.2);
  EXPECT_EQ(published.alert(), nullptr);
}

TEST(LiveAlarmSettings, AnAlertKeepsItsIdAndWhatIsLatchedStays) {
  Published published("{latch: all, amplitude: {rotor: {alert: 1.0e-3}}}");
  published.tell(2.0e-3, 0.3);
  ASSERT_NE(published.alert(), nullptr);
  const std::uint32_t id = published.alert()->id;
  published.monitor.alerts().acknowledge("", "");
  published.change("{amplitude: {rotor: {alert: 1.5e-3}}, clear_delay: 0.5}");
  published.tell(2.0e-3, 1.0);
  EXPECT_EQ(published.alert()->id, id);
  EXPECT_TRUE(published.alert()->acknowledged);
  published.tell(0.1e-3, 1.0);
  ASSERT_TRUE(published.alert()->latched);
  published.change("{latch: none, amplitude: ~}");
  published.tell(0.1e-3, 5.0);
  ASSERT_NE(published.alert(), nullptr);
  EXPECT_EQ(published.alert()->id, id);
  EXPECT_EQ(published.monitor.alerts().reset(published.time), 1u);
}

TEST(LiveAlarmSettings, ASetDelayThatRunsGoesOn) {
  Published published("{delays: {WHIRL_AMPLITUDE: {set: 3}}, amplitude: {rotor: {alert: 1.0e-3}}}");
  published.tell(2.0e-3, 2.5);
  published.change("{subsynchronous: {rotor: 1.0e-5}}");
  published.tell(2.0e-3, 0.4);
  EXPECT_EQ(published.alert(), nullptr);
  published.tell(2.0e-3, 0.3);
  EXPECT_NE(published.alert(), nullptr);
}

}  // namespace live_alarm_settings_test
}  // namespace whirl_twin
