// Zones of vibration and whirl slower than the shaft, on what OrderState says.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "messages/alert.h"
#include "monitoring/vibration_alarms.h"
#include "twin/order_observer.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace order_alarm_test {

AlarmSettings withLevels() {
  AlarmSettings settings;
  settings.zones["rotor"] = {50e-6, 100e-6, 200e-6};
  settings.subsynchronous["rotor"] = 20e-6;
  return settings;
}

struct Published {
  explicit Published(const AlarmSettings& settings = withLevels()) : alarm("rotor", settings) {
    orders.valid = true;
    orders.speed = 200.0;
  }
  void tell(double duration, double acceleration = 0.0) {
    for (const double end = orders.at.time + duration; orders.at.time < end - 1e-9;
         orders.at.time += 0.05) {
      alarm.update(orders, acceleration, alerts);
    }
  }
  void line(double frequency, double forward, double backward = 0.0) {
    orders.line_frequency = {frequency};
    orders.line_ratio = {frequency / orders.speed};
    orders.line_forward = {forward};
    orders.line_backward = {backward};
    orders.line_growth = {0.0};
  }
  const state::Alert* zone() const { return alerts.find("rotor", alert_type::kVibrationZone); }
  const state::Alert* whirl() const {
    return alerts.find("rotor", alert_type::kSubsynchronousWhirl);
  }

  OrderAlarm alarm;
  AlertList alerts;
  state::OrderState orders;
};

TEST(VibrationZone, WarnsInCIsDangerInDAndClearsInB) {
  Published published;
  published.orders.peak_to_peak = 99e-6;
  published.tell(1.0);
  EXPECT_EQ(published.zone(), nullptr);
  published.orders.peak_to_peak = 120e-6;
  published.tell(0.1);
  ASSERT_NE(published.zone(), nullptr);
  EXPECT_EQ(published.zone()->severity, state::Severity::kWarning);
  EXPECT_NE(published.zone()->text.find("zone C"), std::string::npos) << published.zone()->text;
  published.orders.peak_to_peak = 250e-6;
  published.tell(0.1);
  EXPECT_EQ(published.zone()->severity, state::Severity::kDanger);
  EXPECT_NE(published.zone()->text.find("zone D"), std::string::npos) << published.zone()->text;
  published.orders.peak_to_peak = 90e-6;
  published.tell(0.9);
  EXPECT_NE(published.zone(), nullptr);
  published.tell(0.3);
  EXPECT_EQ(published.zone(), nullptr);
}

TEST(VibrationZone, LevelsAreMultipliedInStartUp) {
  AlarmSettings settings = withLevels();
  settings.trip_multiply = 3.0;
  Published published(settings);
  published.orders.peak_to_peak = 250e-6;
  published.tell(1.0, 5.0);
  EXPECT_EQ(published.zone(), nullptr);
  published.tell(2.0, 0.0);
  ASSERT_NE(published.zone(), nullptr);
  EXPECT_EQ(published.zone()->severity, state::Severity::kDanger);
}

TEST(SubsynchronousWhirl, IsAForwardLineBelowTheSpeedAndAboveItsLevel) {
  Published published;
  published.line(96.0, 19e-6);
  published.tell(1.0);
  EXPECT_EQ(published.whirl(), nullptr) << "too small";
  published.line(96.0, 1e-6, 30e-6);
  published.tell(1.0);
  EXPECT_EQ(published.whirl(), nullptr) << "backward";
  published.line(250.0, 30e-6);
  published.tell(1.0);
  EXPECT_EQ(published.whirl(), nullptr) << "faster than the shaft";
  published.line(96.0, 30e-6);
  published.tell(0.2);
  ASSERT_NE(published.whirl(), nullptr);
  EXPECT_NE(published.whirl()->text.find("96.0 rad/s, 0.48 times the speed"), std::string::npos)
      << published.whirl()->text;
  published.orders.valid = false;
  published.line(96.0, 0.0);
  published.tell(3.0);
  EXPECT_NE(published.whirl(), nullptr) << "without orders nothing is known";
  published.orders.valid = true;
  published.tell(1.2);
  EXPECT_EQ(published.whirl(), nullptr);
}

TEST(SubsynchronousWhirl, IsOilWhirlWhereTheRatioStaysAndWhipWhereTheFrequencyStays) {
  for (const bool whip : {false, true}) {
    Published published;
    for (double speed = 200.0; speed < 230.0; speed += 1.0) {
      published.orders.speed = speed;
      published.line(whip ? 99.0 : 0.47 * speed, 40e-6);
      published.tell(0.1);
    }
    ASSERT_NE(published.whirl(), nullptr);
    const char* expected =
        whip ? "keeps its frequency: oil whip" : "keeps its ratio to the speed: oil";
    EXPECT_NE(published.whirl()->text.find(expected), std::string::npos) << published.whirl()->text;
  }
}

struct Rubbing : Published {
  Rubbing() : Published(levels()) { orders.precession = 1.0; }
  static AlarmSettings levels() {
    AlarmSettings settings;
    settings.rub["rotor"] = {20e-6, 10e-6};
    return settings;
  }
  /// An ellipse of a forward and a backward circle [m].
  void circles(double forward, double backward) {
    orders.peak_to_peak = 2.0 * (forward + backward);
    // As the order filter has it: area swept beside what steps of that length could sweep.
    double swept = 0.0, most = 0.0;
    for (double angle = 0.0; angle < 6.28; angle += 0.01) {
      const std::complex<double> f = std::polar(forward, angle), b = std::polar(backward, -angle);
      swept += (std::conj(f + b) * (f - b)).real();
      most += std::abs(f + b) * std::abs(f - b);
    }
    orders.precession = swept / most;
  }
  const state::Alert* rub() const { return alerts.find("rotor", alert_type::kRub); }
};

TEST(Rub, IsToldByWhatWhirlsBackward) {
  Rubbing published;
  published.circles(300e-6, 19e-6);
  published.tell(1.0);
  EXPECT_EQ(published.rub(), nullptr);
  published.circles(60e-6, 22e-6);
  published.tell(0.2);
  ASSERT_NE(published.rub(), nullptr);
  EXPECT_EQ(published.rub()->severity, state::Severity::kWarning);
  EXPECT_NEAR(published.rub()->amplitude, 22e-6, 0.3e-6);
  EXPECT_NE(published.rub()->text.find("backward whirl 2"), std::string::npos)
      << published.rub()->text;
  published.circles(60e-6, 500e-6);
  published.tell(0.2);
  EXPECT_EQ(published.rub()->severity, state::Severity::kDanger);
  EXPECT_NE(published.rub()->text.find("stop the machine"), std::string::npos)
      << published.rub()->text;
  published.circles(60e-6, 1e-6);
  published.tell(1.3);
  EXPECT_EQ(published.rub(), nullptr);
}

TEST(Rub, IsToldByAHalfAndAThirdOfTheSpeedAndByNoOtherLine) {
  for (const double part : {1.0 / 2.0, 1.0 / 3.0}) {
    Rubbing published;
    published.circles(60e-6, 0.0);
    published.line(0.47 * published.orders.speed, 50e-6);
    published.tell(1.0);
    EXPECT_EQ(published.rub(), nullptr);
    published.line(part * published.orders.speed, 9e-6);
    published.tell(1.0);
    EXPECT_EQ(published.rub(), nullptr);
    published.line(part * published.orders.speed, 5e-6, 8e-6);
    published.tell(0.2);
    ASSERT_NE(published.rub(), nullptr);
    EXPECT_NEAR(published.rub()->amplitude, 13e-6, 1e-12);
    EXPECT_EQ(published.rub()->severity, state::Severity::kWarning);
  }
}

TEST(OrderAlarm, WithoutLevelsSaysNothing) {
  Published published(AlarmSettings{});
  published.orders.peak_to_peak = 1.0;
  published.orders.precession = -1.0;
  published.line(100.0, 1.0);
  published.tell(5.0);
  EXPECT_TRUE(published.alerts.active().empty());
}

// The shipped scene from its quiet speed into the whip, under the monitor.
TEST(OrderAlarm, OilWhipIsNamedBeforeItIsWide) {
  AlarmSettings settings;
  settings.subsynchronous["rotor"] = 10e-6;
  WatchedTwin watched(readSceneFile(WHIRL_TWIN_SOURCE "/config/scenes/oil_whip.yaml"), settings);
  OrderObserver orders(watched.twin);
  double raised_at = 0.0;
  while (watched.observer.moment(0).time < 10.6) {
    watched.run(watched.twin.scene().stepSeconds());
    orders.take(watched.record.data(), watched.observer);
    orders.tell(watched.observer, {0},
                [&](const std::string&, auto make) { watched.monitor.take(make(), watched.wall); });
    const double time = watched.observer.moment(0).time;
    const state::Alert* alert =
        watched.monitor.alerts().find("rotor", alert_type::kSubsynchronousWhirl);
    if (time < 1.4 || (time > 6.5 && time < 8.0)) {  // else it swings freely after its ramps
      EXPECT_EQ(alert, nullptr) << time << " " << (alert == nullptr ? "" : alert->text);
    }
    if (alert != nullptr && time > 8.0 && raised_at == 0.0) {
      raised_at = time;
    }
  }
  EXPECT_GT(raised_at, 8.0);
  const state::Alert* alert =
      watched.monitor.alerts().find("rotor", alert_type::kSubsynchronousWhirl);
  ASSERT_NE(alert, nullptr);
  EXPECT_NE(alert->text.find("whip"), std::string::npos) << alert->text;
  EXPECT_LT(alert->amplitude, 50e-6);
}

}  // namespace order_alarm_test
}  // namespace whirl_twin
