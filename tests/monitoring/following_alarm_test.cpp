// What a follower says of its machine becomes alerts that name the cause, and go with it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "messages/alert.h"
#include "monitoring/model_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace following_alarm_test {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A rotor that is followed well: two probes, one parameter, ten messages a second.
state::FollowState wellFollowed() {
  state::FollowState follow;
  follow.system = "rotor";
  follow.parameter = {"stiffness"};
  follow.parameter_unit = {"N/m"};
  follow.value = {1.7e7};
  follow.deviation = {5.0e4};
  follow.channel = {"probes/probe_x", "probes/probe_y"};
  follow.channel_unit = {"m", "m"};
  follow.residual = {1.0e-6, -1.0e-6};
  follow.residual_deviation = {3.0e-6, 3.0e-6};
  follow.offset = {0.0, 0.0};
  follow.channel_status = {0, 0};
  follow.mismatch = 1.01;
  follow.mismatch_least = 0.9;
  follow.mismatch_limit = 1.1;
  follow.whiteness = 0.01;
  follow.whiteness_limit = 0.1;
  follow.drift = 0.2;
  follow.drift_limit = 5.0;
  follow.clock_offset = 0.002;
  follow.clock_drift = 2.0e-5;
  follow.shaft_known = true;
  follow.shaft_angle_deviation = 1.0e-3;
  return follow;
}

struct Published {
  explicit Published(bool has_shaft = true, const AlarmSettings& settings = {})
      : alarm("rotor", has_shaft, settings) {}
  void tell(double duration, bool mismatch_told = false) {
    for (const double end = follow.at.time + duration; follow.at.time < end - 1e-9;
         follow.at.time += 0.1) {
      alarm.update(follow, mismatch_told, alerts);
    }
  }
  const state::Alert* find(const char* type) const { return alerts.find("rotor", type); }
  std::string text(const char* type) const {
    const state::Alert* alert = find(type);
    return alert == nullptr ? "" : alert->text;
  }

  EstimatorAlarm alarm;
  AlertList alerts;
  state::FollowState follow = wellFollowed();
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(EstimatorAlarm, IsSilentOfAMachineThatIsItsModel) {
  Published published;
  published.tell(60.0);
  EXPECT_TRUE(published.alerts.active().empty());
}

TEST(EstimatorAlarm, ResidualsBeyondEitherLimitAreAMismatch) {
  for (const double mismatch : {1.2, 0.8}) {
    Published published;
    published.follow.mismatch = mismatch;
    published.tell(0.1);
    ASSERT_NE(published.find(alert_type::kModelMismatch), nullptr) << mismatch;
    EXPECT_EQ(published.find(alert_type::kModelMismatch)->severity, state::Severity::kWarning);
    const std::string text = published.text(alert_type::kModelMismatch);
    EXPECT_TRUE(has(text, mismatch > 1.0 ? "(NIS) 1.2, expected 1, above the limit 1.1"
                                         : "(NIS) 0.8, expected 1, below the limit 0.9"))
        << text;
    // Within the limits, but not together with the model yet.
    published.follow.mismatch = mismatch > 1.0 ? 1.08 : 0.92;
    published.tell(5.0);
    EXPECT_NE(published.find(alert_type::kModelMismatch), nullptr);
    published.follow.mismatch = 1.0;
    published.tell(0.9);
    EXPECT_NE(published.find(alert_type::kModelMismatch), nullptr);
    published.tell(0.3);
    EXPECT_EQ(published.find(alert_type::kModelMismatch), nullptr);
  }
}

TEST(EstimatorAlarm, ResidualsThatLastAreAMismatchOfEitherSign) {
  for (const double whiteness : {0.3, -0.3}) {
    Published published;
    published.follow.whiteness = whiteness;
    published.tell(0.1);
    EXPECT_TRUE(
        has(published.text(alert_type::kModelMismatch), "autocorrelation of the innovations"));
  }
}

TEST(EstimatorAlarm, BeforeAWindowHasEndedThereIsNoMismatch) {
  Published published;
  published.follow.mismatch = 3.0;
  published.follow.mismatch_least = published.follow.mismatch_limit = kNone;
  published.follow.whiteness_limit = kNone;
  published.tell(5.0);
  EXPECT_EQ(published.find(alert_type::kModelMismatch), nullptr);
}

TEST(EstimatorAlarm, WhileTheAuditOfTheDecaySpeaksItDoesNot) {
  Published published;
  published.follow.mismatch = 1.2;
  published.tell(1.0, true);
  EXPECT_EQ(published.find(alert_type::kModelMismatch), nullptr);
  published.tell(0.1, false);  // and continues where that has ended
  EXPECT_NE(published.find(alert_type::kModelMismatch), nullptr);
  published.follow.mismatch = 1.0;
  published.tell(3.0, true);
  EXPECT_NE(published.find(alert_type::kModelMismatch), nullptr);  // the audit's by now
}

TEST(EstimatorAlarm, ADriftTellsWhichFromWhereToWhereAndSinceWhen) {
  Published published;
  published.tell(10.0);
  published.follow.drift_parameter = "stiffness";
  published.follow.drift_from = 1.7e7;
  published.follow.drift_to = 1.649e7;
  published.follow.drift_since = 3.5;
  published.follow.drift = 6.0;
  published.tell(0.1);
  const std::string text = published.text(alert_type::kDrift);
  for (const char* part : {"stiffness", "from 1.7e+07 to 1.649e+07 N/m", "(-3 %)", "since 3.5 s"}) {
    EXPECT_TRUE(has(text, part)) << part << " in: " << text;
  }
  // Unchanged numbers publish nothing; another direction does.
  published.alerts.takeChanged();
  published.follow.drift_to = 1.64e7;
  published.tell(0.1);
  EXPECT_FALSE(published.alerts.takeChanged());
  published.follow.drift_to = 1.75e7;
  published.tell(0.1);
  EXPECT_TRUE(published.alerts.takeChanged());
  published.follow.drift_parameter.clear();
  published.follow.drift_limit = kNone;  // a new reference is being estimated: nothing is known
  published.tell(5.0);
  EXPECT_NE(published.find(alert_type::kDrift), nullptr);
  published.follow.drift_limit = 5.0;
  published.tell(1.2);
  EXPECT_EQ(published.find(alert_type::kDrift), nullptr);
}

TEST(EstimatorAlarm, AChannelThatIsNotUsedForLongIsNamed) {
  for (const auto& [status, how] : {std::pair(1, "has no new samples"), std::pair(2, "is rejected"),
                                    std::pair(3, "is invalid")}) {
    Published published;
    published.follow.channel_status[1] = static_cast<std::uint8_t>(status);
    published.tell(1.9);
    EXPECT_EQ(published.find(alert_type::kSensor), nullptr);
    published.tell(0.3);
    const std::string text = published.text(alert_type::kSensor);
    EXPECT_TRUE(has(text, std::string("probes/probe_y ") + how)) << text;
    EXPECT_FALSE(has(text, "probe_x")) << text;
    published.follow.channel_status[1] = 0;
    published.tell(1.2);
    EXPECT_EQ(published.find(alert_type::kSensor), nullptr);
  }
}

TEST(EstimatorAlarm, AChannelThatComesAndGoesIsNone) {
  Published published;
  for (int i = 0; i < 30; ++i) {
    published.follow.channel_status[0] = static_cast<std::uint8_t>(i % 2);
    published.tell(1.5);
  }
  EXPECT_EQ(published.find(alert_type::kSensor), nullptr);
}

TEST(EstimatorAlarm, ShaftAndClockAreSensorsToo) {
  Published published;
  published.follow.shaft_known = false;
  published.follow.clock_offset = -3600.0;  // somebody has set it by an hour
  published.tell(2.2);
  const std::string text = published.text(alert_type::kSensor);
  EXPECT_TRUE(has(text, "the shaft's angle is unknown")) << text;
  EXPECT_TRUE(has(text, "the machine's clock has an offset of -3.6e+03 s")) << text;
  published.follow.shaft_known = true;
  published.follow.clock_offset = 0.0;
  published.follow.clock_drift = 1.0e-3;
  published.tell(4.0);
  EXPECT_TRUE(has(published.text(alert_type::kSensor), "drifts by +0.001 s/s"));
}

TEST(EstimatorAlarm, WhatIsNotThereIsNotMissed) {
  // A pendulum has no keyphasor, and its clocks are the same; or nobody asks.
  Published pendulum(false);
  pendulum.follow.shaft_known = false;
  pendulum.follow.clock_offset = kNone;
  pendulum.follow.clock_drift = kNone;
  pendulum.tell(10.0);
  EXPECT_TRUE(pendulum.alerts.active().empty());
  AlarmSettings settings;
  settings.clock_offset = settings.clock_drift = 0.0;
  Published unasked(true, settings);
  unasked.follow.clock_offset = unasked.follow.clock_drift = 1.0e9;
  unasked.tell(10.0);
  EXPECT_TRUE(unasked.alerts.active().empty());
}

TEST(EstimatorAlarm, AHundredDeadChannelsFitATextThatAMessageCarries) {
  Published published;
  for (int i = 0; i < 100; ++i) {
    published.follow.channel.push_back("probes/channel_" + std::to_string(i));
    published.follow.channel_status.push_back(1);
  }
  published.tell(2.2);
  EXPECT_NO_THROW(requireText("text", published.text(alert_type::kSensor)));
  EXPECT_TRUE(has(published.text(alert_type::kSensor), "..."));
}

/// What a motor turns is followed by its pulses: without them its shaft is not known.
TEST(EstimatorAlarm, AKeyphasorIsMissedOfAShaftOnAMotorToo) {
  for (const char* drive :
       {"{motor: {stall_torque: 0.3, no_load_speed: 400.0}}", "{speed: 45.0}"}) {
    std::string scene = R"(
name: rig
step: 0.001
drives: {shaft: DRIVE}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 5.0, stiffness: 2.0e5, damping: 40.0, eccentricity: 2.0e-4, polar_inertia: 0.02}
)";
    WatchedTwin watched(sceneOf(scene.replace(scene.find("DRIVE"), 5, drive)));
    watched.run(0.5);
    state::FollowState follow = wellFollowed();
    follow.shaft_known = false;
    for (follow.at.time = 0.5; follow.at.time < 4.0; follow.at.time += 0.1) {
      watched.wall += 0.1;
      watched.monitor.take(follow, watched.wall);
    }
    const state::Alert* alert = watched.monitor.alerts().find("rotor", alert_type::kSensor);
    ASSERT_NE(alert, nullptr) << drive;
    EXPECT_TRUE(has(alert->text, "the shaft's angle is unknown; check the keyphasor"))
        << alert->text;
  }
}

TEST(EstimatorAlarm, IsInTheMonitor) {
  WatchedTwin watched(sceneOf(kThreeSystems));
  watched.run(1.0);
  state::FollowState follow = wellFollowed();
  follow.drift_parameter = "stiffness";
  const auto tell = [&](double duration) {
    for (const double end = follow.at.time + duration; follow.at.time < end - 1e-9;) {
      follow.at.time += 0.1;
      watched.wall += 0.1;
      watched.monitor.take(follow, watched.wall);
    }
  };
  follow.at.time = 1.0;
  tell(0.5);
  const AlertList& alerts = watched.monitor.alerts();
  EXPECT_NE(alerts.find("rotor", alert_type::kDrift), nullptr);
  follow.drift_parameter.clear();
  tell(2.0);
  EXPECT_EQ(alerts.find("rotor", alert_type::kDrift), nullptr);
  follow.system = "nobody";
  tell(1.0);  // is ignored
  follow.system = "rotor";
  // States have ceased for seconds by now: a dead probe is reported all the same.
  follow.channel_status[0] = 1;
  tell(4.0);
  EXPECT_NE(alerts.find("rotor", alert_type::kSensor), nullptr);
}

}  // namespace following_alarm_test
}  // namespace whirl_twin
