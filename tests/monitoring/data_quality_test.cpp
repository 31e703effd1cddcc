// Data quality: bad data are reported beside the alarms, raise none and clear none, and break no
// delay.
#include "monitoring/data_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "messages/alert.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace data_quality_test {

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

/// A monitor that receives a whirl [m] for a while.
struct Published {
  Published() : monitor(build(sceneOf(kCalm)), levels()) {}
  void tell(double radius, double duration) {
    tell([=](double t) { return circularWhirl("", t, radius, 50.0).x; },
         [=](double t) { return circularWhirl("", t, radius, 50.0).y; }, duration);
  }
  void tell(const std::function<double(double)>& x, const std::function<double(double)>& y,
            double duration) {
    for (const double end = time + duration; time < end - 1.0e-9; time += 0.01) {
      state::WhirlState whirl = circularWhirl("rotor", time, 0.0, 50.0);
      whirl.x = x(time);
      whirl.y = y(time);
      whirl.radius = std::hypot(whirl.x, whirl.y);
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
  Published told;
  EXPECT_EQ(told.notOk(), "stale: no state received yet");
  told.tell(2.0e-3, 0.5);
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
  Published told;
  told.tell(0.1e-3, 0.5);
  told.tell(9.0e-3, 2.0);
  EXPECT_FALSE(told.raised());
  EXPECT_EQ(told.notOk(), "out of range: whirl 9 mm 0-peak, above 5 mm");
  told.tell(4.0e-3, 0.5);
  EXPECT_TRUE(told.raised());
  told.tell(9.0e-3, 5.0);
  EXPECT_TRUE(told.raised());
}

TEST(DataQuality, AGapIsNoTimeWithoutTheCause) {
  Published told;
  told.tell(2.0e-3, 0.5);
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

double whirlX(double time) {
  return 0.2e-3 * std::cos(50.0 * time);
}
double whirlY(double time) {
  return 0.2e-3 * std::sin(50.0 * time);
}

TEST(StuckChannel, IsNotOkRaisesAndClearsNothingAndComesBack) {
  Published told;
  told.tell([](double t) { return 7.0 * whirlX(t); }, whirlY, 1.0);
  ASSERT_TRUE(told.raised());
  const double held = 0.3e-3;  // below the level
  told.tell([=](double) { return held; }, whirlY, 0.2);
  EXPECT_EQ(told.notOk(), "") << "not yet known";
  told.tell([=](double) { return held; }, whirlY, 5.0);
  EXPECT_EQ(told.notOk(), "stuck: x");
  EXPECT_TRUE(told.raised());
  told.tell(whirlX, whirlY, 0.9);
  EXPECT_EQ(told.notOk(), "");
  EXPECT_TRUE(told.raised()) << "its delay begins anew";
  told.tell(whirlX, whirlY, 0.2);
  EXPECT_FALSE(told.raised());
  const double last = whirlX(told.time);
  told.tell([=](double) { return last; }, [](double) { return 0.0; }, 1.0);
  EXPECT_EQ(told.notOk(), "stuck: x, y") << "y reads nothing, x the same again and again";
}

// Each of these stands still at last, or often, and none is stuck.
TEST(StuckChannel, IsNotWhatComesToRestOrIsCoarse) {
  struct Trial {
    const char* what;
    std::function<double(double)> x;
  };
  const auto coarse = [](double x) { return 20.0e-6 * std::round(x / 20.0e-6); };
  for (const Trial& trial : {
           Trial{"never moved", [](double) { return 0.1e-3; }},
           Trial{
               "dies away about a sag",
               [](double t) { return -0.3e-3 + 1.0e-3 * std::exp(-5.0 * t) * whirlX(t) / 0.2e-3; }},
           Trial{"dies away at once, for such samples",
                 [](double t) { return -0.3e-3 + 1.0e-3 * std::exp(-600.0 * t); }},
           Trial{"sampled once a turn, at last",
                 [](double t) { return 0.2e-3 * std::cos(3.0 * std::exp(-20.0 * t)); }},
           Trial{"coarse", [=](double t) { return coarse(0.3 * whirlX(t)); }},
           Trial{"coarse, and dies away",
                 [=](double t) { return coarse(4.0 * std::exp(-2.0 * t) * whirlX(t)); }},
           Trial{"moves in jumps", [](double t) { return 1.0e-4 * std::floor(2.0 * t); }},
       }) {
    Published told;
    for (int i = 0; i < 400; ++i) {
      told.tell(trial.x, whirlY, 0.05);
      ASSERT_EQ(told.notOk(), "") << trial.what << ", t = " << told.time;
    }
  }
}

TEST(StuckChannel, IsNotWhatStandsStillSinceAGapOrAReset) {
  Published told;
  told.tell(whirlX, whirlY, 1.0);
  told.time += 0.5;  // nothing came meanwhile, and the machine has come to rest
  told.tell(0.05e-3, 2.0);
  EXPECT_EQ(told.notOk(), "");
}

}  // namespace data_quality_test
}  // namespace whirl_twin
