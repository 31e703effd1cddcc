// Levels of whirl, over the speed, with their delays; trip multiply while a shaft starts up.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "messages/alert.h"
#include "monitoring/vibration_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace amplitude_alarm_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

AlarmSettings levels(double alert, double danger) {
  AlarmSettings settings;
  settings.amplitude["rotor"] = {{}, {alert}, {danger}};
  return settings;
}

/// An alarm that receives one radius [m] for a while.
struct Published {
  explicit Published(const AlarmSettings& settings) : alarm("rotor", settings) {}
  void tell(double radius, double duration, double speed = 100.0, double acceleration = 0.0) {
    for (const double end = time + duration; time < end - 1.0e-9; time += 0.01) {
      alarm.update(time, radius, speed, acceleration, alerts);
    }
  }
  const state::Alert* alert() const { return alerts.find("rotor", alert_type::kWhirlAmplitude); }

  AmplitudeAlarm alarm;
  AlertList alerts;
  double time = 0.0;
};

TEST(AmplitudeAlarm, WarnsAboveAlertIsDangerAboveDangerAndClearsBelowBoth) {
  Published published(levels(1.0e-3, 2.0e-3));
  published.tell(0.99e-3, 1.0);
  EXPECT_EQ(published.alert(), nullptr);
  published.tell(1.01e-3, 0.02);
  ASSERT_NE(published.alert(), nullptr);
  EXPECT_EQ(published.alert()->severity, state::Severity::kWarning);
  EXPECT_EQ(published.alert()->amplitude_limit, 1.0e-3);
  const auto id = published.alert()->id;
  published.tell(2.01e-3, 0.02);
  EXPECT_EQ(published.alert()->severity, state::Severity::kDanger);
  EXPECT_EQ(published.alert()->amplitude, 2.01e-3);
  EXPECT_EQ(published.alert()->amplitude_limit, 2.0e-3);
  EXPECT_EQ(published.alert()->id, id);
  published.tell(0.99e-3, 3.0);
  EXPECT_NE(published.alert(), nullptr) << "within the hysteresis of 2 %";
  published.tell(kNan, 3.0);
  EXPECT_NE(published.alert(), nullptr) << "what cannot be judged clears nothing";
  published.tell(0.97e-3, 0.9);
  EXPECT_NE(published.alert(), nullptr);
  published.tell(0.97e-3, 0.2);
  EXPECT_EQ(published.alert(), nullptr);
}

TEST(AmplitudeAlarm, HasNoLevelsIfNothingIsSaid) {
  Published published((AlarmSettings()));
  published.tell(1.0, 2.0);
  EXPECT_EQ(published.alert(), nullptr);
}

TEST(AmplitudeAlarm, WaitsForItsSetDelayWithoutABreak) {
  AlarmSettings settings = levels(1.0e-3, 2.0e-3);
  settings.delays[alert_type::kWhirlAmplitude] = {0.5, 2.0};
  Published published(settings);
  for (int i = 0; i < 5; ++i) {
    published.tell(3.0e-3, 0.4);
    published.tell(0.5e-3, 0.05);
  }
  EXPECT_EQ(published.alert(), nullptr);
  published.tell(3.0e-3, 0.55);
  EXPECT_NE(published.alert(), nullptr);
  published.tell(0.5e-3, 1.9);
  EXPECT_NE(published.alert(), nullptr);
  published.tell(0.5e-3, 0.2);
  EXPECT_EQ(published.alert(), nullptr);
}

TEST(AmplitudeAlarm, LevelsAreLinearBetweenSpeedsAndHeldBeyond) {
  const AmplitudeLevels over_speed{{50.0, 150.0}, {1.0, 3.0}, {}};
  EXPECT_EQ(over_speed.alertAt(0.0), 1.0);
  EXPECT_EQ(over_speed.alertAt(-75.0), 1.5);
  EXPECT_EQ(over_speed.alertAt(150.0), 3.0);
  EXPECT_EQ(over_speed.alertAt(1.0e4), 3.0);
  EXPECT_TRUE(std::isinf(over_speed.dangerAt(75.0)));
}

TEST(AmplitudeAlarm, LevelsAreMultipliedWhileTheShaftGainsSpeedAndASecondAfter) {
  AlarmSettings settings = levels(1.0e-3, 2.0e-3);
  settings.trip_multiply = 3.0;
  Published published(settings);
  published.tell(2.5e-3, 1.0, 100.0, 10.0);
  EXPECT_EQ(published.alert(), nullptr) << "it starts up";
  published.tell(2.5e-3, 0.9, 100.0, 0.0);
  EXPECT_EQ(published.alert(), nullptr);
  published.tell(2.5e-3, 0.2, 100.0, 0.0);
  ASSERT_NE(published.alert(), nullptr);
  EXPECT_EQ(published.alert()->severity, state::Severity::kDanger);

  Published slowing(settings);
  slowing.tell(2.5e-3, 0.1, 100.0, -10.0);
  EXPECT_NE(slowing.alert(), nullptr) << "a shaft that runs down is protected as ever";
  Published backward(settings);
  backward.tell(2.5e-3, 0.1, -100.0, -10.0);
  EXPECT_EQ(backward.alert(), nullptr) << "it gains speed the other way round";
  Published large(settings);
  large.tell(6.5e-3, 0.1, 100.0, 10.0);
  EXPECT_NE(large.alert(), nullptr) << "never blind";
}

/// A run-up through a resonance at 100 rad/s, about 0.9 mm of whirl at 20 rad/s^2.
constexpr char kRunUp[] = R"(
name: run_up
step: 0.001
drives: {shaft: {speed: 20.0, profile: [{speed: 200.0, max_acceleration: 20.0}]}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 1.0e-4}
)";

TEST(AmplitudeAlarm, ARunUpTripsUnlessItsLevelsAreMultiplied) {
  AlarmSettings settings = levels(0.3e-3, 0.5e-3);
  WatchedTwin plain(sceneOf(kRunUp), settings);
  plain.run(9.0);
  EXPECT_EQ(plain.count(alert_type::kWhirlAmplitude, false), 1u);
  settings.trip_multiply = 4.0;
  WatchedTwin multiplied(sceneOf(kRunUp), settings);
  multiplied.run(9.0);
  EXPECT_EQ(multiplied.count(alert_type::kWhirlAmplitude, true), 0u);
}

}  // namespace amplitude_alarm_test
}  // namespace whirl_twin
