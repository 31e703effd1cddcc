// Not-OK: what cannot be judged is said, apart from the alarms, raises none and clears none, and
// is no time without a cause.
#include "monitoring/data_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "messages/alert_types.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace {

constexpr char kCalm[] = R"(
name: calm
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, speed: 50.0}
)";

AlarmSettings levels() {
  AlarmSettings settings;
  AmplitudeLevels& of_rotor = settings.amplitude["rotor"];
  of_rotor.alert = {1.0e-3};
  of_rotor.range = 5.0e-3;
  return settings;
}

/// A monitor that is told a whirl [m] for a while.
struct Told {
  Told() : monitor(build(sceneOf(kCalm)), levels()) {}
  void tell(double x, double duration) {
    for (const double end = time + duration; time < end - 1.0e-9; time += 0.01) {
      state::WhirlState whirl;
      whirl.system = "rotor";
      whirl.at.time = time;
      whirl.x = x;
      whirl.radius = std::abs(x);
      whirl.speed = 50.0;
      monitor.take(whirl, time);
      monitor.tick(time, false);
    }
  }
  bool raised() { return monitor.alerts().find("rotor", alert_type::kWhirlAmplitude) != nullptr; }
  std::string notOk() { return monitor.status(time, false).not_ok.at(0); }

  TwinMonitor monitor;
  double time = 0.0;  ///< [s], simulated and wall
};

TEST(DataQuality, WhatIsNotFiniteClearsNothingAndBreaksTheClearDelay) {
  Told told;
  EXPECT_EQ(told.notOk(), "stale: nothing has come yet");
  told.tell(2.0e-3, 0.1);
  EXPECT_EQ(told.notOk(), "");
  ASSERT_TRUE(told.raised());
  told.tell(0.1e-3, 0.9);
  told.tell(std::numeric_limits<double>::quiet_NaN(), 5.0);
  EXPECT_TRUE(told.raised());
  EXPECT_EQ(told.notOk(), "not finite: x");
  told.tell(0.1e-3, 0.9);
  EXPECT_TRUE(told.raised());
  EXPECT_EQ(told.notOk(), "");
  told.tell(0.1e-3, 0.2);
  EXPECT_FALSE(told.raised());
}

TEST(DataQuality, BeyondItsRangeAWhirlIsNoMeasurement) {
  Told told;
  told.tell(0.1e-3, 0.5);
  told.tell(9.0e-3, 2.0);
  EXPECT_FALSE(told.raised());
  EXPECT_EQ(told.notOk(), "out of range: whirl 9 mm, beyond 5 mm");
  told.tell(4.0e-3, 0.1);
  EXPECT_TRUE(told.raised());
  told.tell(9.0e-3, 5.0);
  EXPECT_TRUE(told.raised());
}

TEST(DataQuality, AGapIsNoTimeWithoutTheCause) {
  Told told;
  told.tell(2.0e-3, 0.1);
  told.tell(0.1e-3, 0.9);
  for (const double end = told.time + 5.0; told.time < end; told.time += 0.1) {
    told.monitor.tick(told.time, false);
  }
  EXPECT_TRUE(told.raised());
  EXPECT_EQ(told.notOk().find("stale: no state for 5."), 0u) << told.notOk();
  EXPECT_EQ(told.monitor.status(told.time, true).not_ok.at(0), "") << "it is held";
  told.tell(0.1e-3, 0.9);
  EXPECT_TRUE(told.raised());
  told.tell(0.1e-3, 0.2);
  EXPECT_FALSE(told.raised());
}

}  // namespace
}  // namespace whirl_twin
