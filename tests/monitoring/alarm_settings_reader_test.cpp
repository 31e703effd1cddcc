// The file of settings is read like a scene: what is not said has its default, and all that is
// wrong is named at once.
#include "monitoring/alarm_settings_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "messages/alert.h"
#include "scene/scene_error.h"

namespace whirl_twin {
namespace alarm_settings_reader_test {

AlarmSettings settingsOf(const std::string& text) {
  return readAlarmSettings(YAML::Load(text), "monitor.yaml", {"rotor", "pump"}, {"lcm_url"});
}

std::vector<std::string> errorsOf(const std::string& text) {
  try {
    settingsOf(text);
  } catch (const SceneError& error) {
    return error.errors();
  }
  return {};
}

TEST(AlarmSettingsReader, TheShippedFileAndNothingAreTheDefaults) {
  const YAML::Node file = YAML::LoadFile(std::string(WHIRL_TWIN_SOURCE) + "/config/monitor.yaml");
  for (const AlarmSettings& read :
       {settingsOf("{}"), readAlarmSettings(file, "monitor.yaml", {"rotor"}, {})}) {
    const AlarmSettings defaults;
    EXPECT_EQ(read.clear_delay, defaults.clear_delay);
    EXPECT_EQ(read.energy_residual, defaults.energy_residual);
    EXPECT_EQ(read.latch, Latch::kNone);
    EXPECT_EQ(read.trip_multiply, 1.0);
    EXPECT_TRUE(read.delays.empty());
    EXPECT_TRUE(read.amplitude.empty());
    EXPECT_TRUE(read.zones.empty());
    EXPECT_TRUE(read.subsynchronous.empty());
    EXPECT_TRUE(read.rub.empty());
    EXPECT_EQ(read.decay_audit, 0.0);
    EXPECT_EQ(read.delaysOf(alert_type::kUnstable).set, 0.0);
    EXPECT_EQ(read.delaysOf(alert_type::kUnstable).clear, 1.0);
  }
}

TEST(AlarmSettingsReader, ReadsLevelsDelaysAndLatch) {
  const AlarmSettings read = settingsOf(R"(
lcm_url: ""
clear_delay: 1.5
latch: danger
trip_multiply: 3
delays:
  UNSTABLE: {set: 0.5}
  LOW_DAMPING: {set: 1, clear: 4}
amplitude:
  rotor: {alert: 1.0e-3, danger: 2.0e-3}
  pump: {speed: [0, 100], danger: [1.0e-3, 3.0e-3]}
)");
  EXPECT_EQ(read.latch, Latch::kDanger);
  EXPECT_EQ(read.trip_multiply, 3.0);
  EXPECT_EQ(read.delaysOf(alert_type::kUnstable).set, 0.5);
  EXPECT_EQ(read.delaysOf(alert_type::kUnstable).clear, 1.5);
  EXPECT_EQ(read.delaysOf(alert_type::kLowDamping).clear, 4.0);
  EXPECT_EQ(read.delaysOf(alert_type::kStopped).clear, 1.5);
  EXPECT_EQ(read.amplitude.at("rotor").alertAt(77.0), 1.0e-3);
  EXPECT_NEAR(read.amplitude.at("pump").dangerAt(50.0), 2.0e-3, 1.0e-15);
}

TEST(AlarmSettingsReader, NamesAllThatIsWrongWithTheNearestName) {
  const std::vector<std::string> errors = errorsOf(R"(
clear_dely: 1.0
clear_delay: -1
dwell_limit: long
latch: dangers
trip_multiply: 50
delays:
  UNSTABEL: {set: 0.5}
  LOW_DAMPING: {set: -1, clar: 2}
amplitude:
  roter: {alert: 1.0e-3}
  rotor: {alert: 2.0e-3, danger: 1.0e-3, range: 1.5e-3}
  pump: {speed: [0, 100, 50], alert: [1.0e-3, 0.0]}
)");
  const std::vector<std::string> expected{
      "clear_dely: unknown parameter; did you mean 'clear_delay'?",
      "clear_delay: must be >= 0 s, found -1",
      "dwell_limit: must be",
      "trip_multiply: must be from 1 to 10 (dimensionless), found 50",
      "latch: must be none, danger or all, found 'dangers'; did you mean 'danger'?",
      "delays.UNSTABEL: unknown type of alert; did you mean 'UNSTABLE'?",
      "delays.LOW_DAMPING.clar: unknown key of delays; did you mean 'clear'?",
      "delays.LOW_DAMPING.set: must be from 0 to 3600 s, found -1",
      "amplitude.roter: unknown rotor of the scene; did you mean 'rotor'?",
      "amplitude.rotor.danger: must be above alert, 0.002 m, found 0.001",
      "amplitude.rotor.range: must be above the levels, 0.002 m, found 0.0015",
      "amplitude.pump.speed[2]: must be greater than the one before, 100 rad/s, found 50",
      "amplitude.pump.alert[1]: must be > 0 m, found 0.0",
      "amplitude.pump.alert: must be 3 [m], one for each speed, found 2"};
  for (const std::string& text : expected) {
    bool found = false;
    for (const std::string& error : errors) {
      found = found || error.find("monitor.yaml: " + text) == 0;
    }
    EXPECT_TRUE(found) << text;
  }
  std::string all;
  for (const std::string& error : errors) {
    all += error + "\n";
  }
  EXPECT_EQ(errors.size(), expected.size()) << all;
}

TEST(AlarmSettingsReader, ReadsWhatIsSetForTheSignal) {
  const AlarmSettings read = settingsOf(R"(
zones: {rotor: {a: 50.0e-6, b: 100.0e-6, c: 150.0e-6}}
subsynchronous: {rotor: 20.0e-6, pump: 30.0e-6}
rub: {rotor: {backward: 15.0e-6}, pump: {subharmonic: 5.0e-6}}
slow_roll: {rotor: {below: 30.0}, pump: {forward: 1.0e-5, forward_lag: 0.5}}
decay_audit: 40
)");
  EXPECT_EQ(read.slow_roll.at("rotor").below, 30.0);
  EXPECT_NEAR(read.slow_roll.at("pump").given.forwardLag(), 0.5, 1e-12);
  EXPECT_EQ(errorsOf("slow_roll: {rotor: {below: 30, forward: 1.0e-5}, pump: {}}").size(), 2u);
  EXPECT_EQ(read.rub.at("rotor").backward, 15.0e-6);
  EXPECT_TRUE(std::isinf(read.rub.at("rotor").subharmonic));
  EXPECT_EQ(read.rub.at("pump").subharmonic, 5.0e-6);
  EXPECT_EQ(errorsOf("rub: {rotor: {}, pump: {backwards: 1.0e-6}}").size(), 3u);
  EXPECT_EQ(errorsOf("rub: {rotor: {backward: 0}}").size(), 1u);
  EXPECT_EQ(read.zones.at("rotor").b, 100.0e-6);
  EXPECT_EQ(read.subsynchronous.at("pump"), 30.0e-6);
  EXPECT_EQ(read.decay_audit, 40.0);
  EXPECT_EQ(errorsOf("zones: {rotor: {a: 2.0e-4, b: 1.0e-4, c: 3.0e-4}}").size(), 1u);
  EXPECT_EQ(errorsOf("zones: {rotor: {a: 2.0e-4, b: 3.0e-4}}").size(), 1u);
  EXPECT_EQ(errorsOf("subsynchronous: {fan: 1.0e-4, rotor: -1}").size(), 2u);
  EXPECT_EQ(errorsOf("decay_audit: 1"),
            std::vector<std::string>{
                "monitor.yaml: decay_audit: must be 0, or from 5 to 3600 s, found 1"});
}

}  // namespace alarm_settings_reader_test
}  // namespace whirl_twin
