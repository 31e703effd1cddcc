// The monitor of a whole scene, fed by a twin that runs as fast as it can.

#include "monitoring/twin_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mechanics/rotors/short_journal_bearing.h"
#include "watched_twin.h"

namespace whirl_twin {

namespace twin_monitor_test {

// Threshold 100 (1 + 10/10) = 200 rad/s, passed upwards and back.
constexpr const char* kSelfExcited = R"(
name: self_excited
step: 0.001
drives:
  shaft:
    speed: 150.0
    profile:
      - {speed: 220.0, max_acceleration: 100.0, dwell: 1.0}
      - {speed: 150.0, max_acceleration: 100.0, dwell: 10.0}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 10.0}
    initial: {x: 1.0e-6}
)";

TEST(TwinMonitor, instabilityIsRaisedAtTheThresholdAndClearedBelowIt) {
  WatchedTwin watched(sceneOf(kSelfExcited));
  watched.run(6.0);
  EXPECT_EQ(watched.count("UNSTABLE", true), 1u);
  EXPECT_EQ(watched.count("UNSTABLE", false), 1u);
  for (const auto& event : watched.events) {
    if (event.type == "UNSTABLE" && event.raised) {
      // Judged in the very step that passed the threshold: within one step's change of speed.
      EXPECT_GT(event.speed, 200.0);
      EXPECT_LT(event.speed, 200.0 + 2.0 * 100.0 * 0.001);
      EXPECT_EQ(event.severity, state::Severity::kDanger);
    }
  }
}

// Parameters that change while it runs: threshold 100 (1 + 10 / c_i).
TEST(TwinMonitor, changedParametersAreJudgedFromTheNextMarginOn) {
  WatchedTwin watched(sceneOf(kSelfExcited));
  watched.run(0.25);
  state::ParameterChange change = watched.observer.parameters(0);
  for (std::size_t i = 0; i < change.names.size(); ++i) {
    change.values[i] = change.names[i] == "internal_damping" ? 40.0 : change.values[i];
  }
  ASSERT_TRUE(watched.monitor.take(change));
  watched.run(0.15);
  EXPECT_NEAR(watched.margins.back().instability_speed, 125.0, 1.0e-9);
  EXPECT_EQ(watched.count("UNSTABLE", true), 1u) << "it runs at 150 rad/s and more";

  EXPECT_TRUE(watched.monitor.take(watched.observer.parameters(0))) << "and back";
  watched.run(0.15);
  EXPECT_NEAR(watched.margins.back().instability_speed, 200.0, 1.0e-9);

  state::ParameterChange other = change;
  other.system = "rotr";
  EXPECT_FALSE(watched.monitor.take(other));
  other = change;
  other.names[0] = "weight";
  EXPECT_FALSE(watched.monitor.take(other));
  other = change;
  other.values.pop_back();
  EXPECT_FALSE(watched.monitor.take(other));
}

TEST(TwinMonitor, marginsComeTenASecondAndTellTheThreshold) {
  WatchedTwin watched(sceneOf(R"(
name: steady
step: 0.001
drives: {shaft: {speed: 150.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 10.0}
    initial: {x: 1.0e-6}
)"));
  watched.run(0.45);
  EXPECT_EQ(watched.margins.size(), 5u);  // at the first step, then every 0.1 s
  for (const auto& margin : watched.margins) {
    EXPECT_NEAR(margin.instability_speed, 200.0, 1.0e-9);
    EXPECT_EQ(margin.verdict_name, "asymptotically_stable");
    EXPECT_EQ(margin.polynomial.size(), 5u);
    EXPECT_EQ(margin.first_column.size(), 5u);
    ASSERT_EQ(margin.critical_speeds.size(), 1u);
  }
}

// From 150 rad/s at 100 rad/s^2 a hundredth of the speed takes 15 ms and more.
TEST(TwinMonitor, aSpeedThatChangesIsJudgedWhereItHasChangedByAHundredth) {
  WatchedTwin watched(sceneOf(kSelfExcited));
  watched.run(0.45);  // to 195 rad/s
  ASSERT_GE(watched.margins.size(), 25u);
  EXPECT_LE(watched.margins.size(), 31u) << "not at every state";
  for (std::size_t i = 1; i < watched.margins.size(); ++i) {
    const double before = watched.margins[i - 1].speed;
    const double step = 100.0 * 0.001;  // rad/s, from one state to the next
    EXPECT_LE(watched.margins[i].speed, 1.01 * before + 1.01 * step);
  }
}

// A run-up from standstill changes by a hundredth at every state: it is judged every 10 ms.
TEST(TwinMonitor, aFastRunUpIsNotJudgedAtEveryState) {
  WatchedTwin watched(sceneOf(R"(
name: run_up
step: 0.001
drives: {shaft: {speed: 0.0, profile: [{speed: 100.0, max_acceleration: 1000.0}]}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 1.0e-6}
)"));
  watched.run(0.1);
  ASSERT_GE(watched.margins.size(), 9u);
  EXPECT_LE(watched.margins.size(), 12u);
}

// The verdict on new parameters does not wait for a state, nor for its turn: it is about the last.
TEST(TwinMonitor, newParametersAreJudgedAtOnce) {
  WatchedTwin watched(sceneOf(kSelfExcited));
  watched.run(0.105);
  watched.monitor.takeMargins();
  state::ParameterChange change = watched.observer.parameters(0);
  for (std::size_t i = 0; i < change.names.size(); ++i) {
    change.values[i] = change.names[i] == "internal_damping" ? 40.0 : change.values[i];
  }
  ASSERT_TRUE(watched.monitor.take(change));
  const std::vector<state::StabilityMargin> margins = watched.monitor.takeMargins();
  ASSERT_EQ(margins.size(), 1u);
  EXPECT_EQ(margins[0].verdict_name, "unstable") << "above 125 rad/s";
  EXPECT_EQ(margins[0].at.step, 105);
  EXPECT_NEAR(margins[0].instability_speed, 125.0, 1.0e-9);
  ASSERT_TRUE(watched.monitor.take(change));
  EXPECT_TRUE(watched.monitor.takeMargins().empty()) << "told again, they are no others";
}

// As when a log of one scene is played beside another: no reading past the end of a state.
TEST(TwinMonitor, aStateOfAnotherKindIsIgnored) {
  WatchedTwin watched(sceneOf(kSelfExcited));
  state::PendulumState pendulum;
  pendulum.system = "rotor";
  pendulum.name = {"theta"};
  pendulum.angle = pendulum.rate = {0.1};
  watched.monitor.take(pendulum, 0.0);
  EXPECT_TRUE(watched.monitor.takeMargins().empty());
}

TEST(TwinMonitor, aRotorAtConstantSpeedOfItsOwnIsWatchedToo) {
  WatchedTwin watched(sceneOf(R"(
name: dwelling
step: 0.001
drives: {other: {speed: 1.0}}
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4, speed: 61.0}
)"));
  watched.run(4.0);
  const auto active = watched.monitor.alerts().active();
  ASSERT_EQ(active.size(), 1u);
  EXPECT_EQ(active[0].type, "IN_CRITICAL_BAND");
  EXPECT_EQ(active[0].severity, state::Severity::kDanger);  // it dwells
}

// A pendulum may swing with little damping: that is no machine fault.
TEST(TwinMonitor, aPendulumRaisesNoDampingAlert) {
  WatchedTwin watched(sceneOf(R"(
name: swing
step: 0.001
drives: {shaft: {speed: 9.0}}
systems:
  pendulum:
    model: spinning_pendulum
    drive: shaft
    parameters: {mass: 0.5, length: 0.2032, damping: 1.0e-5}
    initial: {theta: 0.3}
)"));
  watched.run(2.0);
  EXPECT_TRUE(watched.events.empty());
  ASSERT_FALSE(watched.margins.empty());
  const double cone = std::acos(9.80665 / (0.2032 * 81.0));
  EXPECT_NEAR(watched.margins.back().operating_point[0], cone, 1.0e-9);
}

// A step far too long for the motion shows in the energy balance.
TEST(TwinMonitor, aCoarseStepIsReportedByTheEnergyResidual) {
  WatchedTwin watched(sceneOf(R"(
name: coarse
step: 0.05
drives: {other: {}}
systems:
  pendulum:
    model: double_pendulum
    integrator: runge_kutta_4
    parameters: {mass1: 1.0, mass2: 1.0, length1: 1.0, length2: 1.0}
    initial: {theta1: 2.0, theta2: 2.5}
)"));
  watched.run(10.0);
  EXPECT_GE(watched.count("ENERGY_RESIDUAL", true), 1u);
}

TEST(TwinMonitor, WatchesASceneWhoseStepsCannotBePrepared) {
  TwinMonitor monitor(build(sceneOf(kUnsteppable)), {});
  state::WhirlState whirl;
  whirl.system = "rotor";
  whirl.speed = 10.0;
  monitor.take(whirl, 0.0);
  const std::vector<state::StabilityMargin> margins = monitor.takeMargins();
  ASSERT_EQ(margins.size(), 1u);
  EXPECT_EQ(margins[0].verdict_name, "asymptotically_stable");
  // Internal damping: unstable above w (1 + c / ci), w = 100 rad/s.
  EXPECT_NEAR(margins[0].instability_speed, 225.0, 1.0e-9);
}

TEST(TwinMonitor, JudgesRotorsWhoseWhirlTellsOnlyTwoOfTheirCoordinates) {
  // In journal bearings the operating point is where the film carries the weight; with a motor the
  // shaft's angle is a coordinate; a reduced shaft has none of its whirl's.
  const Scene scene = sceneOf(R"(
step: 0.001
drives: {shaft: {speed: 60.0}, engine: {motor: {torque: 0.01}, speed: 50.0}}
systems:
  film:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 20000.0, gravity_on_shaft: true, bearing_length: 0.01,
      bearing_diameter: 0.025, bearing_clearance: 1.0e-4, bearing_viscosity: 0.1, journal_mass: 0.2}
    initial: {y: -1.0e-3, journal_y: -2.0e-5}
  free:
    model: jeffcott_rotor
    drive: engine
    parameters: {mass: 2.0, stiffness: 20000.0, damping: 20.0, polar_inertia: 0.01}
  shaft:
    model: flexible_rotor
    drive: shaft
    parameters:
      youngs_modulus: 211.0e+9
      density: 7810.0
      elements: [{length: 0.25, outer_diameter: 0.05, count: 6}]
      bearings: [{node: 0, kxx: 1.0e+6, kyy: 1.0e+6, cxx: 100, cyy: 100},
                 {node: 6, kxx: 1.0e+6, kyy: 1.0e+6, cxx: 100, cyy: 100}]
      modes: 8
)");
  WatchedTwin watched(scene);
  watched.run(0.5);
  std::map<std::string, state::StabilityMargin> last;
  for (const state::StabilityMargin& margin : watched.margins) {
    last[margin.system] = margin;
  }
  ASSERT_EQ(last.size(), 3u);
  EXPECT_EQ(last["film"].verdict_name, "asymptotically_stable");
  EXPECT_EQ(last["shaft"].verdict_name, "asymptotically_stable");
  EXPECT_EQ(last["film"].operating_point.size(), 4u);
  EXPECT_EQ(last["free"].operating_point.size(), 3u);
  EXPECT_EQ(last["shaft"].operating_point.size(), 8u);
  // Half of (2 + 0.2) kg on each bearing.
  const JournalPosition rest =
      ShortJournalBearing{0.01, 0.025, 1.0e-4, 0.1}.staticPosition(0.5 * 2.2 * scene.gravity, 60.0);
  EXPECT_NEAR(last["film"].operating_point[2], rest.x, 1.0e-9);
  EXPECT_NEAR(last["film"].operating_point[3], rest.y, 1.0e-9);
}

}  // namespace twin_monitor_test

}  // namespace whirl_twin
