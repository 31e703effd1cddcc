// Display of the instruments: the margin on its scale, the speed beside the barred speed ranges,
// the limits of an orbit, the alarms, the timing of the loop; and only live data.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>

#include "display/instrument_panel.h"
#include "display/layout.h"
#include "display/rotor_display.h"
#include "display/system_display.h"
#include "display/twin_panel.h"
#include "drawn_markers.h"
#include "monitoring/stability_alarm.h"

namespace whirl_twin {
namespace instruments_test {

using Marker = visualization_msgs::Marker;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

StabilityMargin marginOf(double log_decrement) {
  StabilityMargin margin;
  margin.verdict =
      log_decrement < 0.0 ? StabilityMargin::UNSTABLE : StabilityMargin::ASYMPTOTICALLY_STABLE;
  margin.log_decrement = log_decrement;
  margin.decay_rate = 10.0 * log_decrement;
  margin.threshold_below = margin.threshold_above = kNaN;
  margin.unreduced_decay_rate = margin.unreduced_log_decrement = kNaN;
  margin.band_low = {48.0};
  margin.band_high = {71.0};
  return margin;
}

LiveMargin live(const StabilityMargin& margin) {
  LiveMargin live;
  live.margin = boost::make_shared<StabilityMargin>(margin);
  live.age = 0.12;
  return live;
}

std::vector<Marker> panel(const LiveMargin& margin, double speed, bool compact = false) {
  visualization_msgs::MarkerArray markers;
  MarkerCanvas board(markers, "system", Eigen::Isometry3d::Identity());
  drawInstruments(margin, speed, compact, board);
  return markers.markers;
}

bool isShown(const Marker& marker) {
  return marker.action == Marker::ADD;
}

TEST(MarginGauge, TheEdgeOfStabilityPartsRedFromTheRest) {
  for (const double decrement : {-0.1, -0.01, 0.05, 0.3}) {
    const auto markers = panel(live(marginOf(decrement)), kNaN);
    const Marker& red = part(markers, "margin_unstable");
    const double edge = red.pose.position.x + 0.5 * red.scale.x;
    const double pointer = part(markers, "margin_pointer").pose.position.x;
    EXPECT_EQ(pointer > edge, decrement > 0.0) << decrement;
    const Marker& low = part(markers, "margin_low");
    const double asked = low.pose.position.x + 0.5 * low.scale.x;
    EXPECT_EQ(isShown(low), decrement > 0.0) << "unstable, that is all there is to show";
    if (isShown(low)) {
      EXPECT_NEAR(low.pose.position.x - 0.5 * low.scale.x, edge, 1e-9);
      EXPECT_EQ(pointer > asked, decrement > 0.1) << decrement;
    }
  }
}

TEST(MarginGauge, StaysOnItsScaleAndKnowsMotionsThatDoNotSwing) {
  const auto place = [](const StabilityMargin& margin) { return marginScale(live(margin))->place; };
  EXPECT_EQ(place(marginOf(5.0)), 1.0);
  EXPECT_EQ(place(marginOf(-5.0)), 0.0);
  StabilityMargin overdamped = marginOf(kNaN);
  overdamped.verdict = StabilityMargin::ASYMPTOTICALLY_STABLE;
  overdamped.decay_rate = 2.0;
  EXPECT_EQ(place(overdamped), 1.0);
  overdamped.verdict = StabilityMargin::UNSTABLE;
  overdamped.decay_rate = -2.0;
  EXPECT_EQ(place(overdamped), 0.0);
  overdamped.verdict = StabilityMargin::UNCERTAIN;
  overdamped.decay_rate = kNaN;
  EXPECT_FALSE(marginScale(live(overdamped)));
}

TEST(MarginGauge, TellsTheAgeOfTheVerdict) {
  EXPECT_EQ(marginText(live(marginOf(0.314))), "log decrement 0.314 (0.1 required), 0.1 s old");
}

std::vector<std::string> coloursOf(const LiveMargin& margin) {
  const auto markers = panel(margin, kNaN);
  std::vector<std::string> shown;
  for (const char* name : {"margin_unstable", "margin_low", "margin_enough", "margin_pointer"}) {
    if (isShown(part(markers, name))) {
      shown.emplace_back(name);
    }
  }
  return shown;
}

/// Is the pointer in the orange range? Its end, the level itself, is not below the level.
bool isLow(const LiveMargin& margin) {
  const auto markers = panel(margin, kNaN);
  const Marker& low = part(markers, "margin_low");
  const double pointer = part(markers, "margin_pointer").pose.position.x;
  return isShown(low) && pointer >= low.pose.position.x - 0.5 * low.scale.x - 1e-9 &&
         pointer < low.pose.position.x + 0.5 * low.scale.x - 1e-9;
}

AlertList alertsOf(const StabilityMargin& shown, const AlarmSettings& settings) {
  state::StabilityMargin margin;
  margin.system = "system";
  margin.verdict = shown.verdict;
  margin.speed = shown.speed;
  margin.decay_rate = shown.decay_rate;
  margin.log_decrement = shown.log_decrement;
  margin.unreduced_decay_rate = shown.unreduced_decay_rate;
  margin.unreduced_log_decrement = shown.unreduced_log_decrement;
  margin.threshold_below = margin.threshold_above = kNaN;
  AlertList alerts;
  StabilityAlarm("system", settings).update(margin, alerts);
  return alerts;
}

/// Orange where, and only where, the monitor raises LOW_DAMPING.
TEST(MarginGauge, IsOrangeWhereTheMonitorRaisesItsAlarm) {
  for (const double level : {0.0, 0.05, 0.1}) {
    for (const double rate_level : {0.0, 0.3, 2.0}) {
      for (const double decrement : {0.0, 0.0141, 0.07, 0.2}) {
        for (const double unreduced : {kNaN, 0.03, 0.36}) {
          for (const double speed : {kNaN, 100.0}) {
            StabilityMargin margin = marginOf(decrement);
            margin.speed = speed;
            margin.unreduced_log_decrement = unreduced;
            margin.unreduced_decay_rate = 10.0 * unreduced;
            LiveMargin shown = live(margin);
            shown.least_decrement = level;
            shown.least_decay_rate = rate_level;
            AlarmSettings settings;
            settings.log_decrement_warning = level;
            settings.decay_rate_alarm = rate_level;
            const bool raised = !alertsOf(margin, settings).active().empty();
            EXPECT_EQ(isLow(shown), raised) << level << " " << rate_level << " " << decrement << " "
                                            << unreduced << " " << speed;
          }
        }
      }
    }
  }
}

TEST(MarginGauge, ShowsNothingWhereNoDampingIsRequired) {
  StabilityMargin pendulum = marginOf(0.0);
  pendulum.verdict = StabilityMargin::MARGINAL;
  pendulum.speed = kNaN;
  EXPECT_TRUE(coloursOf(live(pendulum)).empty());
  EXPECT_EQ(marginText(live(pendulum)), "");
  EXPECT_FALSE(isShown(part(panel(live(pendulum), kNaN), "margin_track")));
  EXPECT_FALSE(isShown(part(panel(live(pendulum), kNaN), "margin_caption")));
  LiveMargin switched_off = live(marginOf(0.05));
  switched_off.least_decrement = 0.0;
  EXPECT_TRUE(coloursOf(switched_off).empty());
  // Instability is an alarm of every system.
  pendulum.verdict = StabilityMargin::UNSTABLE;
  pendulum.log_decrement = -0.1;
  EXPECT_EQ(coloursOf(live(pendulum)),
            (std::vector<std::string>{"margin_unstable", "margin_pointer"}));
}

/// A gauge without a live verdict has no pointer and no colours, and shows the reason.
TEST(MarginGauge, WhatIsNotLiveShowsNothing) {
  LiveMargin silent;
  silent.why_not = "the last verdict is 12 s old";
  const auto markers = panel(silent, 73.0);
  for (const char* name : {"margin_pointer", "margin_unstable", "margin_low", "margin_enough",
                           "speed_avoid", "speed_unstable"}) {
    EXPECT_FALSE(isShown(part(markers, name))) << name;
  }
  EXPECT_TRUE(isShown(part(markers, "margin_track")));
  EXPECT_TRUE(isShown(part(markers, "speed_pointer"))) << "the state itself is live";
  EXPECT_EQ(part(markers, "margin_caption").text, "margin: the last verdict is 12 s old");
  EXPECT_EQ(marginText({}), "not evaluated yet");
}

TEST(MarginGauge, AVerdictIsLiveForThreeSecondsOrWhileTheSimulationIsHeld) {
  StabilityMargin published = marginOf(0.3);
  published.age = 0.2;
  const auto margin = boost::make_shared<StabilityMargin>(published);
  EXPECT_TRUE(liveMargin(margin, 2.7, false, "").margin);
  EXPECT_NEAR(liveMargin(margin, 2.7, false, "").age, 2.9, 1e-12);
  EXPECT_FALSE(liveMargin(margin, 2.9, false, "").margin);
  EXPECT_EQ(liveMargin(margin, 11.8, false, "").why_not, "the last verdict is 12 s old");
  EXPECT_TRUE(liveMargin(margin, 100.0, true, "").margin);
  EXPECT_FALSE(std::isfinite(liveMargin(margin, 100.0, true, "").age));
  EXPECT_FALSE(liveMargin(margin, 0.1, true, "no message from the monitor for 5 s").margin);
  EXPECT_FALSE(liveMargin(nullptr, 0.0, false, "").margin);
}

TEST(SpeedBar, HasTheBandWhereItBelongs) {
  const auto markers = panel(live(marginOf(0.3)), 60.0);
  const SpeedScale scale = speedScale(60.0, live(marginOf(0.3)).margin.get());
  EXPECT_EQ(scale.end, 100.0);  // 71 and a margin, rounded up
  const Marker& track = part(markers, "speed_track");
  const double left = track.pose.position.x - 0.5 * track.scale.x;
  const auto speedAt = [&](double x) { return (x - left) / track.scale.x * scale.end; };
  const Marker& band = part(markers, "speed_avoid");
  EXPECT_NEAR(speedAt(band.pose.position.x - 0.5 * band.scale.x), 48.0, 1e-9);
  EXPECT_NEAR(speedAt(band.pose.position.x + 0.5 * band.scale.x), 71.0, 1e-9);
  EXPECT_NEAR(speedAt(part(markers, "speed_pointer").pose.position.x), 60.0, 1e-9);
  EXPECT_FALSE(isShown(part(markers, "speed_unstable")));
  EXPECT_EQ(part(markers, "speed_caption").text, "0 to 100 rad/s: avoid 48.0 to 71.0");
}

TEST(SpeedBar, IsRedBeyondTheThreshold) {
  StabilityMargin margin = marginOf(0.3);
  margin.threshold_above = 120.0;
  SpeedScale scale = speedScale(90.0, &margin);
  EXPECT_EQ(scale.end, 150.0);
  ASSERT_EQ(scale.unstable.size(), 1U);
  EXPECT_EQ(scale.unstable[0], SpeedRange(120.0, 150.0));
  EXPECT_EQ(scaleText(scale), "0 to 150 rad/s: avoid 48.0 to 71.0, unstable above 120.0");

  margin = marginOf(-0.1);  // and beyond it
  margin.threshold_below = 120.0;
  scale = speedScale(140.0, &margin);
  ASSERT_EQ(scale.unstable.size(), 1U);
  EXPECT_EQ(scale.unstable[0].first, 120.0);
  EXPECT_EQ(scale.unstable[0].second, scale.end);

  margin = marginOf(-0.1);  // a pendulum upside down that a fast shaft holds up
  margin.threshold_above = 30.0;
  EXPECT_EQ(speedScale(10.0, &margin).unstable[0], SpeedRange(0.0, 30.0));
}

TEST(SpeedBar, OfManyCriticalSpeedsThoseAboutThePresentOneAreSeen) {
  StabilityMargin margin = marginOf(0.3);
  margin.band_low.clear();
  margin.band_high.clear();
  for (int i = 1; i <= 12; ++i) {
    margin.band_low.push_back(100.0 * i - 5.0);
    margin.band_high.push_back(100.0 * i + 5.0);
  }
  const SpeedScale scale = speedScale(720.0, &margin);
  EXPECT_GT(scale.end, 805.0) << "the next one above is on the scale";
  ASSERT_LE(scale.avoid.size(), 4U);
  EXPECT_TRUE(std::any_of(scale.avoid.begin(), scale.avoid.end(),
                          [](const SpeedRange& band) { return band.first == 695.0; }));
  EXPECT_TRUE(std::any_of(scale.avoid.begin(), scale.avoid.end(),
                          [](const SpeedRange& band) { return band.first == 795.0; }));
}

TEST(SpeedBar, IsNotThereWithoutAShaft) {
  for (const Marker& marker : panel(live(marginOf(0.3)), kNaN)) {
    EXPECT_FALSE(marker.ns.rfind("system/speed", 0) == 0 && isShown(marker)) << marker.ns;
  }
}

TEST(OrbitLimits, AreCirclesToTheScaleOfTheWhirlAboutTheMiddleOfTheOrbit) {
  RotorDisplay rotor("rotor", 1000.0, 3.0);
  WhirlState state;
  state.x = state.radius = 1e-4;
  rotor.update(state);
  auto orders = boost::make_shared<OrderState>();
  orders->mean_x = 0.0;
  orders->mean_y = -5e-5;
  SystemStatus status;
  status.orders = orders;
  AlarmSettings settings;
  settings.zones["rotor"] = {80e-6, 150e-6, 220e-6};
  settings.amplitude["rotor"].alert = {2e-4};
  status.limits = vibrationLimits(settings, "rotor", 100.0);
  ASSERT_EQ(status.limits.size(), 4U);
  EXPECT_EQ(limitsText(status.limits),
            "limits: alert level 200 um, zone C 110 um, zone B 75 um, zone A 40 um");
  std::vector<Marker> circles;
  for (const Marker& marker : drawn(rotor, status, Eigen::Vector3d::Zero())) {
    if (marker.ns == "system/limit" && isShown(marker)) {
      circles.push_back(marker);
    }
  }
  ASSERT_EQ(circles.size(), 4U);
  const double radius[] = {0.040, 0.075, 0.110, 0.200};  // half of peak to peak, times 1000
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const Eigen::Vector2d centre(0.0, -0.05);
    for (const auto& point : circles[i].points) {
      EXPECT_NEAR((Eigen::Vector2d(point.x, point.y) - centre).norm(), radius[i], 1e-9);
    }
  }
  EXPECT_GT(circles[2].color.r, 2.0F * circles[2].color.g) << "beyond zone C is danger";
  EXPECT_GT(circles[0].color.g, circles[0].color.r) << "zone A is calm";

  status.limits = {{1e-2, Alert::DANGER, "far"}};
  EXPECT_FALSE(isShown(part(drawn(rotor, status, Eigen::Vector3d::Zero()), "limit")))
      << "ten metres wide it is no part of the picture";
  EXPECT_TRUE(vibrationLimits({}, "rotor", 100.0).empty());
}

Alert alertOf(const std::string& system, const std::string& type, int severity) {
  Alert alert;
  alert.system = system;
  alert.type = type;
  alert.severity = static_cast<std::uint8_t>(severity);
  return alert;
}

TEST(AlarmList, IsBySeverityAndCountsWhatItLeavesOut) {
  std::vector<Alert> alerts = {alertOf("pump", "LOW_DAMPING", Alert::WARNING),
                               alertOf("fan", "UNSTABLE", Alert::DANGER),
                               alertOf("twin", "LCM_LOST", Alert::INFO)};
  alerts[0].acknowledged = true;
  AlarmList list = alarmList(alerts, 20);
  EXPECT_EQ(list.title, "3 alarms, 1 of them danger");
  EXPECT_EQ(list.danger, std::vector<std::string>{"DANGER fan UNSTABLE"});
  EXPECT_EQ(list.warning, std::vector<std::string>{"WARNING pump LOW_DAMPING (acknowledged)"});
  EXPECT_EQ(list.info, std::vector<std::string>{"INFO twin LCM_LOST"});
  list = alarmList(alerts, 1);
  EXPECT_EQ(list.danger.size(), 1U);
  EXPECT_EQ(list.info, std::vector<std::string>{"and 2 more"});
  EXPECT_EQ(alarmList({}, 20).title, "no alarms");
}

LoopStatistics loopOf(std::uint64_t overruns, double achieved) {
  LoopStatistics loop;
  loop.step_size = 1e-3;
  loop.overruns = overruns;
  loop.real_time_factor = 1.0;
  loop.achieved_factor = achieved;
  loop.wakeup_latency_p99 = 12e-6;
  loop.execution_p99 = 1.3e-3;
  return loop;
}

TEST(LoopHealth, TellsLateStepsTheRealTimeFactorAndSilence) {
  LoopHealth health;
  EXPECT_EQ(health.lines(0.0), std::vector<std::string>{"loop: no message received"});
  LoopHealth of_a_follower;
  of_a_follower.setFollowing();
  EXPECT_EQ(of_a_follower.lines(0.0), std::vector<std::string>{"estimates its machine"});
  health.take(loopOf(3, 1.0), 10.0);
  EXPECT_EQ(health.severity(10.5), Alert::INFO) << "late long ago, before anybody looked";
  EXPECT_EQ(health.lines(10.5),
            (std::vector<std::string>{"loop: 1000 steps/s", "  1.00 of real time (1 requested)",
                                      "  overruns 3, skipped 0", "  unpublished 0",
                                      "  wake-up latency 12 us", "  step takes 1.3 ms"}));
  health.take(loopOf(5, 1.0), 11.0);
  EXPECT_EQ(health.severity(11.5), Alert::WARNING);
  EXPECT_EQ(health.lines(11.5)[4], "  2 of them recently");
  health.take(loopOf(5, 1.0), 12.0);
  EXPECT_EQ(health.severity(12.5), Alert::INFO);
  health.take(loopOf(5, 0.8), 13.0);
  EXPECT_EQ(health.severity(13.5), Alert::WARNING) << "it does not keep up";
  EXPECT_EQ(health.lines(20.0), std::vector<std::string>{"loop: no message for 7 s"});
  EXPECT_EQ(health.severity(20.0), Alert::WARNING);
  health.take(loopOf(0, 1.0), 21.0);
  EXPECT_EQ(health.severity(21.5), Alert::INFO) << "its counts began anew";
  LoopStatistics held = loopOf(0, 0.0);
  held.paused = true;
  health.take(held, 22.0);
  EXPECT_EQ(health.severity(22.5), Alert::INFO);
  EXPECT_EQ(health.lines(22.5)[1], "  paused");
}

TEST(TwinPanel, ASilentMonitorsAlarmsAreNotPassedOffAsTheLatest) {
  const Layout layout = layoutOf(2);
  const auto title = [&](const std::string& silence) {
    visualization_msgs::MarkerArray markers;
    drawTwin({alertOf("fan", "UNSTABLE", Alert::DANGER)}, {}, nullptr, silence, 0.0, layout,
             markers);
    for (const Marker& marker : markers.markers) {
      if (marker.ns == "(twin)/title") {
        return marker.text;
      }
    }
    return std::string();
  };
  EXPECT_EQ(title(""), "1 alarm, 1 of them danger");
  EXPECT_EQ(title("no message from the monitor for 5 s: nothing is monitored"),
            "alarms unknown, last: 1 alarm, 1 of them danger");
}

ControllerState controllerOf(std::vector<double> output) {
  ControllerState state;
  state.input = {"rotor.current_x", "rotor.current_y", "other.force_x"};
  state.input_unit = {"A", "A", "N"};
  state.output = std::move(output);
  return state;
}

TEST(CommandBars, ReachFromTheMiddleToWhatActs) {
  LiveController controller;
  controller.take(controllerOf({1.0, -2.0, 0.5}), 4.0);
  const std::vector<Command> commands = controller.commandsOn("rotor");
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commandText(commands[0]), "current_x 1 of 4 A");
  visualization_msgs::MarkerArray markers;
  MarkerCanvas board(markers, "system", Eigen::Isometry3d::Identity());
  const double height = drawCommands(commands, {}, false, 0.2, board);
  EXPECT_GT(height, 0.3);
  std::vector<double> ends;
  for (const Marker& marker : markers.markers) {
    if (marker.ns == "system/command_bar" && isShown(marker)) {
      ends.push_back(marker.pose.position.x - 0.5 * marker.scale.x);
      ends.push_back(marker.pose.position.x + 0.5 * marker.scale.x);
    }
  }
  ASSERT_EQ(ends.size(),
            4u);  // a quarter of half a scale of 1.3 m to the right, a half to the left
  EXPECT_NEAR(ends[0], 0.0, 1e-9);
  EXPECT_NEAR(ends[1], 0.25 * 0.65, 1e-9);
  EXPECT_NEAR(ends[2], -0.5 * 0.65, 1e-9);
  EXPECT_NEAR(ends[3], 0.0, 1e-9);
}

TEST(CommandBars, AreRedWhereTheActuatorGivesNoMore) {
  LiveController controller;
  controller.take(controllerOf({4.0, 3.99, 0.0}), 4.0);
  EXPECT_TRUE(controller.commandsOn("rotor")[0].at_limit);
  EXPECT_FALSE(controller.commandsOn("rotor")[1].at_limit);
}

TEST(CommandBars, WithoutALimitReachToARoundNumberBeyondTheLargest) {
  LiveController controller;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  controller.take(controllerOf({0.0, 0.0, -3.0}), kNone);
  controller.take(controllerOf({0.0, 0.0, 0.1}), kNone);
  const std::vector<Command> commands = controller.commandsOn("other");
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(commands[0].end, 5.0);
  EXPECT_EQ(controller.commandsOn("rotor")[0].end, 1.0);  // nothing so far
}

TEST(CommandBars, AMessageThatIsNotWholeIsLeft) {
  LiveController controller;
  controller.take(controllerOf({1.0}), 4.0);
  EXPECT_TRUE(controller.commandsOn("rotor").empty());
}

TEST(CommandBars, GoWithTheirController) {
  visualization_msgs::MarkerArray markers;
  MarkerCanvas board(markers, "system", Eigen::Isometry3d::Identity());
  EXPECT_EQ(drawCommands({}, {}, false, 0.2, board), 0.2);
  EXPECT_TRUE(std::none_of(markers.markers.begin(), markers.markers.end(), isShown));
}

TEST(CommandBars, TellHowFarTheLoopIsFromInstability) {
  LiveController controller;
  EXPECT_EQ(controller.loopText(), "");
  auto margins = boost::make_shared<ControllerMargins>();
  margins->sensitivity_peak = 2.314;
  margins->zone = "A";
  margins->saturated = 0.12;
  controller.take(margins);
  EXPECT_EQ(controller.loopText(), "sensitivity 2.31, zone A; 12 % saturated");
  margins->sensitivity_peak = std::numeric_limits<double>::infinity();
  margins->zone = "unbounded";
  margins->verdict_name = "unstable";
  EXPECT_EQ(controller.loopText(), "loop unstable");
}

}  // namespace instruments_test
}  // namespace whirl_twin
