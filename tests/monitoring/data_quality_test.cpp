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
  Published published;
  EXPECT_EQ(published.notOk(), "stale: no state received yet");
  published.tell(2.0e-3, 0.5);
  EXPECT_EQ(published.notOk(), "");
  ASSERT_TRUE(published.raised());
  published.tell(0.1e-3, 0.9);
  published.tell(std::numeric_limits<double>::quiet_NaN(), 5.0);
  EXPECT_TRUE(published.raised());
  EXPECT_EQ(published.notOk(), "not finite: x");
  published.tell(0.1e-3, 0.9);
  EXPECT_TRUE(published.raised());
  EXPECT_EQ(published.notOk(), "");
  published.tell(0.1e-3, 0.2);
  EXPECT_FALSE(published.raised());
}

TEST(DataQuality, BeyondItsRangeAWhirlIsNoMeasurement) {
  Published published;
  published.tell(0.1e-3, 0.5);
  published.tell(9.0e-3, 2.0);
  EXPECT_FALSE(published.raised());
  EXPECT_EQ(published.notOk(), "out of range: whirl 9 mm 0-peak, above 5 mm");
  published.tell(4.0e-3, 0.5);
  EXPECT_TRUE(published.raised());
  published.tell(9.0e-3, 5.0);
  EXPECT_TRUE(published.raised());
}

TEST(DataQuality, AGapIsNoTimeWithoutTheCause) {
  Published published;
  published.tell(2.0e-3, 0.5);
  published.tell(0.1e-3, 0.9);
  for (const double end = published.time + 5.0; published.time < end; published.time += 0.1) {
    published.monitor.tick(published.time, false);
  }
  EXPECT_TRUE(published.raised());
  EXPECT_EQ(published.notOk().find("stale: no state for 5."), 0u) << published.notOk();
  EXPECT_EQ(published.monitor.status(published.time, true).not_ok.at(0), "") << "it is held";
  published.tell(0.1e-3, 0.9);
  EXPECT_TRUE(published.raised());
  published.tell(0.1e-3, 0.2);
  EXPECT_FALSE(published.raised());
}

double whirlX(double time) {
  return 0.2e-3 * std::cos(50.0 * time);
}
double whirlY(double time) {
  return 0.2e-3 * std::sin(50.0 * time);
}

TEST(StuckChannel, IsNotOkRaisesAndClearsNothingAndComesBack) {
  Published published;
  published.tell([](double t) { return 7.0 * whirlX(t); }, whirlY, 1.0);
  ASSERT_TRUE(published.raised());
  const double held = 0.3e-3;  // below the level
  published.tell([=](double) { return held; }, whirlY, 0.2);
  EXPECT_EQ(published.notOk(), "") << "not yet known";
  published.tell([=](double) { return held; }, whirlY, 5.0);
  EXPECT_EQ(published.notOk(), "stuck: x");
  EXPECT_TRUE(published.raised());
  published.tell(whirlX, whirlY, 0.9);
  EXPECT_EQ(published.notOk(), "");
  EXPECT_TRUE(published.raised()) << "its delay begins anew";
  published.tell(whirlX, whirlY, 0.2);
  EXPECT_FALSE(published.raised());
  const double last = whirlX(published.time);
  published.tell([=](double) { return last; }, [](double) { return 0.0; }, 1.0);
  EXPECT_EQ(published.notOk(), "stuck: x, y") << "y reads nothing, x the same again and again";
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
    Published published;
    for (int i = 0; i < 400; ++i) {
      published.tell(trial.x, whirlY, 0.05);
      ASSERT_EQ(published.notOk(), "") << trial.what << ", t = " << published.time;
    }
  }
}

TEST(StuckChannel, IsNotWhatStandsStillSinceAGapOrAReset) {
  Published published;
  published.tell(whirlX, whirlY, 1.0);
  published.time += 0.5;  // nothing came meanwhile, and the machine has come to rest
  published.tell(0.05e-3, 2.0);
  EXPECT_EQ(published.notOk(), "");
}

}  // namespace data_quality_test
}  // namespace whirl_twin
