// Sommerfeld's effect: a rotor that its motor does not bring through its critical speed is foretold
// before the band and alarmed when it hangs; one that passes raises neither.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "watched_twin.h"

namespace whirl_twin {
namespace capture_alarm_test {

constexpr const char* kCapture = "SOMMERFELD_CAPTURE";

Scene onMotor(double stall_torque) {
  return sceneOf(fmt::format(R"(
name: sommerfeld
step: 0.001
drives:
  engine: {{motor: {{stall_torque: {}, no_load_speed: 400.0}}, speed: 120.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: engine
    parameters: {{mass: 5.0, stiffness: 2.0e+5, damping: 40.0, eccentricity: 2.0e-4, polar_inertia: 0.02}}
)",
                             stall_torque));
}

const state::Alert* firstOf(const WatchedTwin& watched, state::Severity severity) {
  for (const state::Alert& event : watched.events) {
    if (event.type == kCapture && event.raised && event.severity == severity) {
      return &event;
    }
  }
  return nullptr;
}

TEST(CaptureAlarm, ACaptureIsForetoldBeforeTheBandAndAlarmedWhenTheSpeedStandsStill) {
  WatchedTwin watched(onMotor(0.3));
  double stands_since = 0.0;  // within 0.1 rad/s of where it hangs
  for (int i = 0; i < 250; ++i) {
    watched.run(0.1);
    if (std::fabs(watched.observer.drive(0).speed - 197.9) > 0.5) {
      stands_since = watched.observer.drive(0).at.time;
    }
  }
  const state::Alert* foretold = firstOf(watched, state::Severity::kWarning);
  ASSERT_NE(foretold, nullptr);
  ASSERT_FALSE(watched.margins.empty());
  ASSERT_EQ(watched.margins[0].critical_speeds.size(), 1u) << "held at each speed it is linear";
  EXPECT_NEAR(watched.margins[0].critical_speeds[0].speed, 200.08, 0.01);
  EXPECT_LT(foretold->speed, watched.margins[0].critical_speeds[0].band_low);
  EXPECT_NEAR(foretold->critical_speed, 200.08, 0.01);
  EXPECT_NE(foretold->text.find("resonance capture at 197.9 rad/s"), std::string::npos)
      << foretold->text;
  const state::Alert* danger = firstOf(watched, state::Severity::kDanger);
  ASSERT_NE(danger, nullptr);
  EXPECT_EQ(danger->id, foretold->id);
  EXPECT_NEAR(danger->speed, 197.9, 2.0);
  EXPECT_LT(danger->time, stands_since + 2.0);
  EXPECT_EQ(watched.count(kCapture, false), 0u);
}

TEST(CaptureAlarm, AMotorThatPassesRaisesNone) {
  WatchedTwin watched(onMotor(0.45));
  watched.run(40.0);
  EXPECT_GT(watched.observer.drive(0).speed, 250.0);
  EXPECT_EQ(watched.count(kCapture, true), 0u);
  EXPECT_EQ(watched.count("CRITICAL_SPEED_APPROACH", true), 1u) << "the band is there for it, too";
  EXPECT_GE(watched.count("IN_CRITICAL_BAND", true), 1u);
}

// A motor too weak to reach the band at all just runs at its speed.
TEST(CaptureAlarm, AMotorWhoseOwnSpeedIsBelowTheBandIsNotCaptured) {
  WatchedTwin watched(sceneOf(R"(
name: slow
step: 0.001
drives:
  engine: {motor: {stall_torque: 0.3, no_load_speed: 100.0}, speed: 95.0}
systems:
  rotor:
    model: jeffcott_rotor
    drive: engine
    parameters: {mass: 5.0, stiffness: 2.0e+5, damping: 40.0, eccentricity: 2.0e-4, polar_inertia: 0.02}
)"));
  watched.run(4.0);
  EXPECT_TRUE(watched.events.empty());
}

TEST(CaptureAlarm, AFreeRotorIsWatchedLikeOneOnAMotor) {
  for (const double torque : {0.03, 0.25}) {
    WatchedTwin watched(sceneOf(fmt::format(R"(
name: free
step: 0.002
systems:
  rotor:
    model: free_rotor
    parameters: {{mass: 2.0, stiffness: 200.0, damping: 2.0, eccentricity: 0.01, polar_inertia: 0.02, torque: {}}}
    initial: {{spin_rate: 2.0}}
)",
                                            torque)));
    watched.run(25.0);
    const bool captured = torque < 0.1;
    EXPECT_EQ(firstOf(watched, state::Severity::kWarning) != nullptr, captured) << torque;
    EXPECT_EQ(firstOf(watched, state::Severity::kDanger) != nullptr, captured) << torque;
    ASSERT_EQ(watched.margins[0].critical_speeds.size(), 1u);
    EXPECT_GE(watched.count("IN_CRITICAL_BAND", true), 1u) << torque;
  }
}

// A shaft of elements, with the disc of the Jeffcott rotor above in its middle.
TEST(CaptureAlarm, AFlexibleRotorIsWatchedLikeAJeffcottRotor) {
  WatchedTwin watched(sceneOf(R"(
name: shaft
step: 0.001
drives:
  engine: {motor: {stall_torque: 0.3, no_load_speed: 400.0}, speed: 150.0}
systems:
  rotor:
    model: flexible_rotor
    drive: engine
    parameters:
      {youngs_modulus: 2.1e+11, density: 7800.0, elements: [{length: 0.15, outer_diameter: 0.0172, count: 4}],
      discs: [{node: 2, mass: 4.0, polar_inertia: 0.02, transverse_inertia: 0.013}],
      bearings: [{node: 0, kxx: 1.0e+8}, {node: 4, kxx: 1.0e+8}, {node: 2, cxx: 40.0}],
      unbalances: [{node: 2, magnitude: 1.0e-3}], modes: 4, highest_speed: 400.0}
)"));
  watched.run(20.0);
  const state::Alert* foretold = firstOf(watched, state::Severity::kWarning);
  ASSERT_NE(foretold, nullptr);
  ASSERT_FALSE(watched.margins.empty());
  ASSERT_GE(watched.margins[0].critical_speeds.size(), 1u);
  EXPECT_LT(foretold->speed, watched.margins[0].critical_speeds[0].band_low);
  const state::Alert* danger = firstOf(watched, state::Severity::kDanger);
  ASSERT_NE(danger, nullptr);
  EXPECT_NEAR(watched.observer.drive(0).speed, danger->critical_speed,
              0.03 * danger->critical_speed);
  EXPECT_NE(danger->text.find("resonance capture near"), std::string::npos) << danger->text;
}

// Nonlinear rotors have critical speeds too: those of their small motion where they hang.
TEST(NonlinearRotors, HaveCriticalSpeedsAndBandAlerts) {
  WatchedTwin watched(sceneOf(R"(
name: rub
step: 0.0005
drives:
  shaft:
    speed: 60.0
    profile: [{speed: 160.0, max_acceleration: 40.0, dwell: 3.0}]
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    integrator: runge_kutta_4
    parameters: {mass: 2.0, stiffness: 20000.0, damping: 40.0, eccentricity: 1.0e-4, rub_stiffness: 4.0e5,
      rub_clearance: 1.0e-3, rub_damping: 60.0}
)"));
  watched.run(4.0);
  // As the linear rotor away from the stator, zeta = 0.1: Nc = 100 / sqrt(1 - 2 zeta^2).
  ASSERT_EQ(watched.margins[0].critical_speeds.size(), 1u);
  EXPECT_NEAR(watched.margins[0].critical_speeds[0].speed, 100.0 / std::sqrt(0.98), 1.0e-3);
  EXPECT_EQ(watched.count("CRITICAL_SPEED_APPROACH", true), 1u);
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", true), 1u);
}

}  // namespace capture_alarm_test
}  // namespace whirl_twin
