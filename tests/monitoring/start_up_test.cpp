// Levels that are larger while a shaft starts up are an alert of their own, for so long and no
// longer.
#include <gtest/gtest.h>

#include <random>

#include "messages/alert.h"
#include "monitoring/vibration_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace start_up_test {

constexpr char kRotor[] = R"(
name: starting
step: 0.001
drives: {shaft: {speed: 10.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, eccentricity: 1.0e-5}
)";

AlarmSettings multiplied() {
  AlarmSettings settings;
  settings.trip_multiply = 3.0;
  settings.clear_delay = 0.5;
  settings.amplitude["rotor"].alert = {1.0e-3};
  return settings;
}

const state::Alert* noticeOf(WatchedTwin& watched) {
  return watched.monitor.alerts().find("rotor", alert_type::kTripMultiplied);
}

TEST(StartUp, MultipliedLevelsAreAnAlertWhileTheShaftGainsSpeed) {
  WatchedTwin watched(sceneOf(kRotor), multiplied());
  watched.run(0.5);
  EXPECT_EQ(noticeOf(watched), nullptr);
  watched.twin.setSpeed(0, 30.0, 10.0, 0.0);  // two seconds
  watched.run(1.0);
  ASSERT_NE(noticeOf(watched), nullptr);
  EXPECT_EQ(noticeOf(watched)->severity, state::Severity::kInfo);
  EXPECT_NE(noticeOf(watched)->text.find("multiplied by 3"), std::string::npos);
  watched.run(2.0);
  EXPECT_EQ(noticeOf(watched), nullptr);
  EXPECT_EQ(watched.count(alert_type::kTripMultiplied, false), 1u);
}

TEST(StartUp, WithoutLevelsThereIsNothingToReport) {
  AlarmSettings settings = multiplied();
  settings.amplitude.clear();
  WatchedTwin watched(sceneOf(kRotor), settings);
  watched.twin.setSpeed(0, 30.0, 10.0, 0.0);
  watched.run(1.0);
  EXPECT_EQ(noticeOf(watched), nullptr);
}

TEST(StartUp, OneThatDoesNotEndMultipliesForSoLongOnly) {
  AlarmSettings settings = multiplied();
  settings.max_inhibition = 5.0;
  StartUp start_up(settings);
  for (int i = 0; i < 100; ++i) {
    const double time = 0.1 * i;
    EXPECT_EQ(start_up.multiplier(time, 10.0 + time, 1.0), time < 5.0 - 1e-9 ? 3.0 : 1.0) << time;
  }
  EXPECT_EQ(start_up.multiplier(11.0, 20.0, 0.0), 1.0);
  EXPECT_EQ(start_up.multiplier(12.0, 21.0, 1.0), 3.0) << "another start-up";
}

// A keyphasor at 50 rad/s: pulses a turn apart, a standard deviation of 0.02 rad/s of the speed
// between two of them.
TEST(StartUp, NoiseOfAMeasuredSpeedIsNone) {
  StartUp start_up(multiplied());
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  double before = 50.0;
  for (int i = 0; i < 10'000; ++i) {
    const double speed = 50.0 + noise(random);
    const double acceleration = (speed - before) / 0.126;
    EXPECT_EQ(start_up.multiplier(0.126 * i, speed, i == 0 ? 0.0 : 5.0 * acceleration), 1.0) << i;
    before = speed;
  }
}

TEST(StartUp, ASlowOneAtAnyRateOfMessagesIsOne) {
  for (const double period : {0.001, 0.1, 1.0}) {
    for (const double turns : {1.0, -1.0}) {
      StartUp start_up(multiplied());
      start_up.multiplier(0.0, 10.0 * turns, 0.0);
      double multiplier = 1.0;
      for (double time = period; time < 3.5; time += period) {
        multiplier = start_up.multiplier(time, (10.0 + 0.6 * time) * turns, 0.6 * turns);
      }
      EXPECT_EQ(multiplier, 3.0) << period << " " << turns;
    }
  }
}

}  // namespace start_up_test
}  // namespace whirl_twin
