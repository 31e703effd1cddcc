// Margins of the controllers' loops as the monitor publishes them, and its alert on them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "messages/alert.h"
#include "monitoring/controller_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace loop_alarm_test {

/// x'' = x + u, sampled ten times a second: PD of gains (2, sqrt 2) times `gain`, `delay` [s] late.
Scene levitated(double delay, double gain = 1.0) {
  return sceneOf(fmt::format(
      "{{step: 0.001, systems: {{s: {{model: linear_system, parameters: {{names: [x], mass: "
      "[[1.0]], stiffness: [[-1.0]]}}, initial: {{x: 1.0e-3}}}}}}, controllers: {{pd: {{type: pid, "
      "rate: 10.0, measures: [s.x], acts_on: [s.force_x], delay: {}, parameters: {{kp: {}, ki: "
      "0.0, kd: {}}}}}}}}}",
      delay, 2.0 * gain, std::sqrt(2.0) * gain));
}

state::ControllerMargins judged(const Scene& scene) {
  WatchedTwin live(scene);
  live.run(0.01);
  EXPECT_FALSE(live.loop_margins.empty());
  return live.loop_margins.empty() ? state::ControllerMargins{} : live.loop_margins.back();
}

TEST(LoopMargins, AreOneForEachVerdict) {
  WatchedTwin live(levitated(0.1));
  live.run(1.0);
  EXPECT_EQ(live.loop_margins.size(), live.margins.size());
  const state::ControllerMargins& margins = live.loop_margins.back();
  EXPECT_EQ(margins.controller, "pd");
  EXPECT_EQ(margins.signal, std::vector<std::string>{"s.x"});
  EXPECT_EQ(margins.signal_peak, std::vector<double>{margins.sensitivity_peak});
  EXPECT_EQ(margins.at.step, live.margins.back().at.step);
  EXPECT_TRUE(std::isnan(margins.speed));
  // A spectral radius of 0.926013966 a sample, as computed for one sample of delay.
  EXPECT_NEAR(margins.spectral_radius, 0.926013966, 1e-9);
  EXPECT_NEAR(margins.period, 0.1, 1e-12);
}

TEST(LoopMargins, TellWhereStabilityIsLost) {
  const state::ControllerMargins margins = judged(levitated(0.1));
  EXPECT_EQ(margins.verdict_name, "asymptotically_stable");
  EXPECT_GT(margins.gain_margin, 1.0);
  for (const double part : {0.999, 1.001}) {
    const std::string expected = part < 1.0 ? "asymptotically_stable" : "unstable";
    EXPECT_EQ(judged(levitated(0.1, part * margins.gain_margin)).verdict_name, expected);
    EXPECT_EQ(judged(levitated(0.1, margins.gain_reduction / part)).verdict_name, expected);
    // Between samples the delay is known to the second order of the period.
    EXPECT_EQ(
        judged(levitated(0.1 + (part < 1.0 ? 0.97 : 1.03) * margins.delay_margin)).verdict_name,
        expected);
  }
}

/// x and y as above, tied by 0.5 (y, -x), each with a controller of its own.
Scene levitatedInPlane(double delay) {
  const auto axis = [&](char name) {
    return fmt::format(
        "p{0}: {{type: pid, rate: 10.0, measures: [s.{0}], acts_on: [s.force_{0}], delay: {1}, "
        "parameters: {{kp: 2.0, ki: 0.0, kd: {2}}}}}",
        name, delay, std::sqrt(2.0));
  };
  return sceneOf(fmt::format(
      "{{step: 0.001, systems: {{s: {{model: linear_system, parameters: {{names: [x, y], mass: "
      "[[1.0, 0.0], [0.0, 1.0]], stiffness: [[-1.0, 0.0], [0.0, -1.0]], circulatory: [[0.0, 0.5], "
      "[-0.5, 0.0]]}}}}}}, controllers: {{{}, {}}}}}",
      axis('x'), axis('y')));
}

// One axis alone bears more delay than both at once, as the loop itself has it when it is later.
TEST(LoopMargins, AreOfAllSensorsAtOnce) {
  const state::ControllerMargins margins = judged(levitatedInPlane(0.1));
  ASSERT_EQ(margins.verdict_name, "asymptotically_stable");
  for (const double part : {0.97, 1.03}) {
    EXPECT_EQ(judged(levitatedInPlane(0.1 + part * margins.delay_margin)).verdict_name,
              part < 1.0 ? "asymptotically_stable" : "unstable");
  }
}

TEST(LoopMargins, SayWhyALoopIsNotJudged) {
  const state::ControllerMargins margins = judged(sceneOf(
      "{step: 0.001, systems: {s: {model: linear_system, parameters: {names: [x], mass: [[1.0]], "
      "stiffness: [[1.0]]}}}, controllers: {own: {type: external, rate: 10.0, measures: [s.x], "
      "acts_on: [s.force_x], delay: 0.1, mode: free_running, timeout: 0.5}}}"));
  EXPECT_EQ(margins.verdict_name, "uncertain");
  EXPECT_EQ(margins.objection, "a control law of the loop is not linear");
  EXPECT_TRUE(std::isnan(margins.sensitivity_peak));
  EXPECT_EQ(margins.zone, "");
}

TEST(LoopAlarm, WarnsWhereTheSensitivityIsBeyondZoneB) {
  WatchedTwin sound(levitated(0.1));
  sound.run(1.0);
  EXPECT_LT(sound.loop_margins.back().sensitivity_peak, 3.0);
  EXPECT_EQ(sound.loop_margins.back().zone, "A");
  EXPECT_EQ(sound.count(alert_type::kLoopSensitivity, true), 0u);

  WatchedTwin fragile(levitated(0.4));
  fragile.run(1.0);
  EXPECT_EQ(fragile.margins.back().verdict_name, "asymptotically_stable");
  EXPECT_GT(fragile.loop_margins.back().sensitivity_peak, 5.0);
  EXPECT_EQ(fragile.loop_margins.back().zone, "D");
  ASSERT_EQ(fragile.count(alert_type::kLoopSensitivity, true), 1u);
  const state::Alert alert = fragile.monitor.alerts().active()[0];
  EXPECT_EQ(alert.system, "pd");
  EXPECT_EQ(alert.severity, state::Severity::kWarning);
  EXPECT_NE(alert.text.find("zone D"), std::string::npos) << alert.text;

  AlarmSettings unasked;
  unasked.sensitivity_warning = 0.0;
  WatchedTwin quiet(levitated(0.4), unasked);
  quiet.run(1.0);
  EXPECT_EQ(quiet.count(alert_type::kLoopSensitivity, true), 0u);
}

TEST(LoopAlarm, WhatNothingHoldsIsWithoutBound) {
  // kp takes the negative stiffness away and no more.
  WatchedTwin live(sceneOf(
      "{step: 0.001, systems: {s: {model: linear_system, parameters: {names: [x], mass: [[1.0]], "
      "stiffness: [[-1.0]]}}}, controllers: {pd: {type: pid, rate: 10.0, measures: [s.x], acts_on: "
      "[s.force_x], delay: 0.1, parameters: {kp: 1.0, ki: 0.0, kd: 1.0}}}}"));
  live.run(0.5);
  EXPECT_EQ(live.loop_margins.back().verdict_name, "marginal");
  EXPECT_TRUE(std::isinf(live.loop_margins.back().sensitivity_peak));
  EXPECT_EQ(live.count(alert_type::kLoopSensitivity, true), 1u);
}

TEST(LoopAlarm, OfAnUnstableLoopUnstableSpeaks) {
  WatchedTwin live(levitated(0.7));
  live.run(0.5);
  EXPECT_EQ(live.loop_margins.back().zone, "unbounded");
  EXPECT_EQ(live.count(alert_type::kUnstable, true), 1u);
  EXPECT_EQ(live.count(alert_type::kLoopSensitivity, true), 0u);
}

state::ControllerMargins peak(double time, double sensitivity) {
  state::ControllerMargins margins;
  margins.at.time = time;
  margins.controller = "pd";
  margins.verdict = 0;
  margins.sensitivity_peak = sensitivity;
  return margins;
}

TEST(LoopAlarm, LetsGoBeyondItsHysteresis) {
  AlertList list;
  ControllerAlarms alarm(controllerNamed("pd"), AlarmSettings{});
  alarm.update(peak(0.0, 4.01), list);
  EXPECT_EQ(list.active().size(), 1u);
  for (int i = 1; i < 40; ++i) {
    alarm.update(peak(0.1 * i, 3.95), list);  // within 2 %
  }
  EXPECT_EQ(list.active().size(), 1u);
  for (int i = 40; i < 60; ++i) {
    alarm.update(peak(0.1 * i, 3.9), list);
  }
  EXPECT_TRUE(list.active().empty());
}

}  // namespace loop_alarm_test
}  // namespace whirl_twin
