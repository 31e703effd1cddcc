// Texts of the displays and the terminal, and the topics that they subscribe to.
#include <gtest/gtest.h>

#include <limits>

#include "display/status_text.h"
#include "display/terminal_text.h"
#include "transport/ros_converters.h"

namespace whirl_twin {
namespace display_text_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

StabilityMargin rotorMargin() {
  StabilityMargin margin;
  margin.verdict_name = "asymptotically_stable";
  margin.speed = 150.0;
  margin.decay_rate = 5.0;
  margin.log_decrement = 0.3145;
  margin.critical_speed = {50.0, 140.0, 400.0, 900.0};
  margin.direction = {"backward", "forward", "forward", "forward"};
  margin.separation_margin = {66.7, 6.67, 166.7, 500.0};
  margin.required_separation_margin = {16.0, 16.0, 26.0, 26.0};
  return margin;
}

Alert alert(unsigned id, int severity, double raised_time) {
  Alert alert;
  alert.id = id;
  alert.type = "IN_CRITICAL_BAND";
  alert.system = "rotor";
  alert.severity = static_cast<std::uint8_t>(severity);
  alert.raised_time = raised_time;
  alert.time = raised_time;
  alert.text = "rotor: do not dwell";
  return alert;
}

TEST(FollowText, TellsParametersToTheirDeviationsAndWhatIsNotUsed) {
  FollowState follow;
  follow.parameter = {"stiffness", "coulomb1", "gone", "known"};
  follow.parameter_unit = {"N/m", "N m", "", ""};
  follow.value = {7123.456, 2.8912e-4, kNan, 0.25};
  follow.deviation = {12.34, 5.94e-5, 1.0, 0.0};
  follow.channel = {"probes/x", "probes/y"};
  follow.channel_status = {FollowState::USED, FollowState::REFUSED};
  follow.mismatch = kNan;
  EXPECT_EQ(followLines(follow),
            (std::vector<std::string>{"stiffness 7123 +- 12 N/m", "coulomb1 0.00029 +- 5.9e-05 N m",
                                      "gone nan", "known 0.25", "probes/y rejected"}));
  follow.mismatch = 1.21;
  EXPECT_EQ(followLines(follow).back(), "residual 1.10 of that expected");
  follow.parameter_unit.clear();  // no message of ours
  follow.channel.clear();
  EXPECT_EQ(followLines(follow).size(), 1U);
}

TEST(StatusText, WrapsAngles) {
  EXPECT_NEAR(wrappedDegrees(3.0 * M_PI), 180.0, 1e-9);
  EXPECT_NEAR(wrappedDegrees(-M_PI), 180.0, 1e-9);
  EXPECT_NEAR(wrappedDegrees(-0.1), -5.72957795, 1e-6);
  EXPECT_NEAR(wrappedDegrees(200.0 * M_PI + 0.5), 28.6478898, 1e-6);
}

TEST(StatusText, GivesWhirlInMicrometresAndTheLagOnlyWhereItExists) {
  EXPECT_EQ(vibrationText(123.44e-6), "vibration 123.4 um 0-peak");
  EXPECT_EQ(vibrationText(NAN), "");
  OrderState orders;
  orders.valid = true;
  orders.forward = true;
  orders.order = {1.0};
  orders.forward_amplitude = {100.0e-6};
  orders.backward_amplitude = {20.0e-6};
  orders.forward_lag = {M_PI / 2};
  orders.deviation = {1.0e-7};
  EXPECT_EQ(ordersText(orders), "1X 120.0 um, lag 90.0 deg, forward");
  orders.mean_y = -23.0e-6;
  EXPECT_EQ(ordersText(orders), "1X 120.0 um, lag 90.0 deg, forward");
  orders.mean_y = -50.0e-6;
  EXPECT_EQ(ordersText(orders), "1X 120.0 um, lag 90.0 deg, forward, mean 50.0 um from the axis");
  orders.mean_y = 0.0;
  orders.deviation = {1.0e-3};
  EXPECT_EQ(ordersText(orders), "1X 120.0 um, forward");
  orders.valid = false;
  orders.forward = false;
  EXPECT_EQ(ordersText(orders), "backward");
}

// Oil whip: the operator must see the non-synchronous component, not the lag of a whirl that has
// none.
TEST(StatusText, NamesTheLineThatIsLargerThanTheFirstOrder) {
  OrderState orders;
  orders.valid = orders.forward = true;
  orders.order = {1.0};
  orders.forward_amplitude = {5.0e-6};
  orders.backward_amplitude = {0.0};
  orders.forward_lag = {M_PI};
  orders.deviation = {1.0e-9};
  orders.line_frequency = {98.65};
  orders.line_forward = {170.0e-6};
  orders.line_backward = {14.0e-6};
  EXPECT_EQ(ordersText(orders), "1X 5.0 um, lag 180.0 deg, forward, 98.7 rad/s 184.0 um");
  orders.line_forward = {1.0e-6};
  orders.line_backward = {0.0};
  EXPECT_EQ(ordersText(orders), "1X 5.0 um, lag 180.0 deg, forward");
}

TEST(StatusText, SpeedInBothUnits) {
  EXPECT_EQ(speedText(100.0), "speed 100.00 rad/s (954.9 rpm)");
}

TEST(StatusText, NamesTheCriticalSpeedNearestToTheSpeed) {
  const auto margin = rotorMargin();
  const int nearest = nearestCriticalSpeed(margin);
  EXPECT_EQ(criticalSpeedText(margin, nearest), "critical 140.0 rad/s forward");
  EXPECT_EQ(separationText(margin, nearest), "margin 6.7 % (16.0 % required)");
  EXPECT_EQ(nearestCriticalSpeed(StabilityMargin()), -1);
  EXPECT_EQ(criticalSpeedText(StabilityMargin(), -1), "");
}

TEST(StatusText, LeavesOutAMarginThatIsUndefinedAtStandstill) {
  auto margin = rotorMargin();
  margin.speed = 0.0;
  margin.separation_margin[0] = kNan;
  EXPECT_EQ(nearestCriticalSpeed(margin), 0);
  EXPECT_EQ(separationText(margin, 0), "");
}

TEST(StatusText, TellsDecayFromGrowth) {
  auto margin = rotorMargin();
  EXPECT_EQ(decayText(margin), "decay rate 5 1/s, log decrement 0.315");
  margin.decay_rate = -0.5;
  margin.log_decrement = kNan;
  EXPECT_EQ(decayText(margin), "growth rate 0.5 1/s");
  EXPECT_EQ(verdictText(margin), "asymptotically stable");
}

TEST(StatusText, ShowsTheCriticalSpeedsAroundThePresentOne) {
  const auto text = joinedLines(marginLines(rotorMargin()));
  EXPECT_NE(text.find("critical 140.0"), std::string::npos);
  EXPECT_EQ(text.find("critical 900.0"), std::string::npos);
}

TEST(StatusText, BreaksSentencesAtSpaces) {
  const auto lines = wrapText("shaft speed is inside the critical band", 20);
  for (const auto& line : lines) {
    EXPECT_LE(line.size(), 20U);
  }
  EXPECT_EQ(lines[0], "shaft speed is");
  EXPECT_EQ(lines[1], "  inside the");
  EXPECT_TRUE(wrapText("", 20).empty());
  EXPECT_EQ(wrapText("unbreakable", 4), std::vector<std::string>{"unbreakable"});
}

TEST(TerminalText, ReadoutSaysWhatIsKnown) {
  SystemReadout readout;
  auto pendulum = boost::make_shared<PendulumState>();
  pendulum->name = {"theta1", "theta2"};
  pendulum->angle = {M_PI / 6, -M_PI / 2};
  readout.pendulum = pendulum;
  EXPECT_EQ(readoutText("arm", readout), "arm: theta1 30.0 deg, theta2 -90.0 deg");
  readout.pendulum.reset();
  readout.margin = boost::make_shared<StabilityMargin>(rotorMargin());
  EXPECT_EQ(readoutText("rotor", readout),
            "rotor: asymptotically stable, decay rate 5 1/s, log decrement 0.315, "
            "critical 140.0 rad/s forward, margin 6.7 % (16.0 % required)");
}

// A disc that hangs 50 um aside and whirls with 20 um about there, two revolutions of 100 samples.
TEST(TerminalText, VibrationIsWithoutSag) {
  SystemReadout readout;
  auto whirl = boost::make_shared<WhirlState>();
  whirl->header.frame_id = "rotor";
  whirl->speed = 100.0;
  for (int i = 0; i <= 200; ++i) {
    const double angle = 2.0 * M_PI * i / 100.0;
    whirl->time = angle / whirl->speed;
    whirl->shaft_angle = angle;
    whirl->x = 20.0e-6 * std::cos(angle);
    whirl->y = 20.0e-6 * std::sin(angle) - 50.0e-6;
    readout.vibration = readout.followed.take(fromRos(*whirl));
    EXPECT_EQ(std::isnan(readout.vibration), i < 100) << i;
  }
  readout.whirl = whirl;
  EXPECT_EQ(readoutText("rotor", readout),
            "rotor: speed 100.00 rad/s (954.9 rpm), vibration 20.0 um 0-peak");
}

TEST(TerminalText, AlertsAreToldWhenTheyComeChangeAndGo) {
  const auto warning = alert(1, Alert::WARNING, 2.0);
  const auto danger = alert(1, Alert::DANGER, 2.0);
  EXPECT_EQ(alertChanges({}, {warning}, 2.0),
            std::vector<std::string>{"[2.000 s] WARNING raised: rotor: do not dwell"});
  EXPECT_TRUE(alertChanges({warning}, {warning}, 2.5).empty());
  EXPECT_EQ(alertChanges({warning}, {danger}, 3.0),
            std::vector<std::string>{"[2.000 s] DANGER now: rotor: do not dwell"});
  EXPECT_EQ(alertChanges({danger}, {}, 4.0),
            std::vector<std::string>{"[4.000 s] DANGER cleared: rotor IN_CRITICAL_BAND"});
}

TEST(TerminalText, ARestartedMonitorsAlertIsAnother) {
  EXPECT_EQ(
      alertChanges({alert(1, Alert::WARNING, 2.0)}, {alert(1, Alert::WARNING, 0.5)}, 0.5).size(),
      2U);
}

TEST(TerminalText, FitsTheTerminal) {
  EXPECT_EQ(fitted("a long line", 80), "a long line");
  EXPECT_EQ(fitted("a long line", 8), "a lon...");
}

TEST(TwinTopics, AreKnownByTheirTypeAndName) {
  const auto topics = twinTopics({{"/twin/rotor/whirl", "whirl_twin/WhirlState"},
                                  {"/twin/arm/pendulum", "whirl_twin/PendulumState"},
                                  {"/twin/rotor/stability", "whirl_twin/StabilityMargin"},
                                  {"/twin/drives/shaft", "whirl_twin/DriveState"},
                                  {"/twin/alerts", "whirl_twin/AlertArray"},
                                  {"/twin/loop", "whirl_twin/LoopStatistics"},
                                  {"/twin/controllers/pd", "whirl_twin/ControllerState"},
                                  {"/twin/controllers/pd/margins", "whirl_twin/ControllerMargins"},
                                  {"/twin/rotor/joint_states", "sensor_msgs/JointState"},
                                  {"/other/rotor/whirl", "whirl_twin/WhirlState"},
                                  {"/rosout", "rosgraph_msgs/Log"}},
                                 "/twin");
  std::vector<std::string> subjects;
  for (const auto& topic : topics) {
    subjects.push_back(topic.subject);
  }
  EXPECT_EQ(subjects,
            (std::vector<std::string>{"rotor", "arm", "rotor", "shaft", "", "", "pd", "pd"}));
}

}  // namespace display_text_test
}  // namespace whirl_twin
