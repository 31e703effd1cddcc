// A shaft that its motor brings through a resonance under a speed controller: passed, aborted or
// rejected, but never captured for long.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../scene/scenes.h"
#include "scene/scene_reader.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace supervised_speed_test {

using state::Supervision;

constexpr double kInertia = 0.005;  // kg m^2
constexpr double kTwoPi = 6.28318530717958647692;

/// A rotor on a motor, from a speed below its critical one to one above.
struct Machine {
  std::string rotor = "mass: 5.0, stiffness: 2.0e5, damping: 10.0, eccentricity: 5.0e-5";
  double critical = 200.0;    ///< [rad/s]
  double acceleration = 1.0;  ///< [rad/s^2], of the first attempt
  double again = 8.0;         ///< [rad/s^2]
  double torque = 0.042;      ///< [N m]
  double drag = 0.0;          ///< [N m s/rad]
  bool tries_what_is_weak = false;
  double turns = 1.0;  ///< sign of the speeds

  double from() const { return 0.85 * critical; }
  double to() const { return 1.15 * critical; }
  double target() const { return 1.5 * critical; }
  /// [s], of the supervisor.
  double window() const { return std::max((to() - from()) / again, 20.0 * kTwoPi / from()); }

  Scene scene() const {
    return sceneOf(fmt::format(
        "{{step: 0.001, drives: {{shaft: {{speed: {0}, motor: {{torque: 0.0, drag: {1}}}}}}}, "
        "systems: {{rotor: {{model: jeffcott_rotor, drive: shaft, integrator: runge_kutta_4, "
        "parameters: {{{2}, polar_inertia: 0.005}}}}}}, controllers: {{governor: {{type: speed, "
        "rate: 1000.0, measures: [rotor.spin_rate], acts_on: [rotor.torque], parameters: {{speed: "
        "{3}, max_acceleration: {4}, retry_acceleration: {5}, max_jerk: {6}, inertia: 0.005, drag: "
        "{1}, kp: 0.1, ki: 0.2, motor: [{{speed: 0, torque: {7}}}], critical_speeds: true, margin: "
        "0.15, weak_motor: {8}}}}}}}}}",
        turns * 0.6 * critical, drag, rotor, turns * target(), acceleration, again, 4.0 * again,
        torque, tries_what_is_weak ? "try" : "refuse"));
  }
};

struct Outcome {
  Supervision end = Supervision::kNone;
  double speed = 0.0;  ///< [rad/s], at the end
  int retreats = 0;
  double furthest = 0.0;  ///< [rad/s]
  /// [s], of a stay at the torque limit in the band or less than its width below it, minus the time
  /// that one which advances by a fiftieth of the plan needs for its gain in speed.
  double longest_stay = 0.0;
};

/// Until the result is known, but for at most `time` [s].
Outcome run(const Machine& machine, double time) {
  Twin twin(machine.scene());
  const RunningController& governor = twin.control().controllers()[0];
  Outcome outcome;
  double since = -1.0;
  double speed_then = 0.0;
  int settled = 0;
  for (int k = 0; k < static_cast<int>(time * 1000.0) && settled < 10000; ++k) {
    twin.step();
    ShaftState shaft;
    twin.running(0).shaft(shaft);
    outcome.speed = machine.turns * shaft.speed;
    outcome.furthest = std::max(outcome.furthest, outcome.speed);
    const double speed = outcome.speed;
    const bool near = speed < machine.to() && speed > 2.0 * machine.from() - machine.to();
    if (near && machine.turns * governor.acting(0) >= machine.torque * (1.0 - 1e-9)) {
      if (since < 0.0) {
        since = k * 1e-3;
        speed_then = speed;
      }
      const double least = 0.02 * std::min(machine.acceleration, 0.5 * machine.torque / kInertia);
      const double gained = std::max(0.0, speed - speed_then) / least;
      outcome.longest_stay = std::max(outcome.longest_stay, k * 1e-3 - since - gained);
    } else {
      since = -1.0;
    }
    const Supervision now = governor.supervision();
    outcome.retreats +=
        now == Supervision::kRetreating && outcome.end != Supervision::kRetreating ? 1 : 0;
    outcome.end = now;
    const bool there = std::abs(speed - machine.target()) < 1e-4 * machine.target();
    const bool stays = (now == Supervision::kGivenUp || now == Supervision::kRefused) &&
                       std::abs(shaft.acceleration) < 1e-2 * machine.acceleration;
    settled = (now == Supervision::kNone && there) || stays ? settled + 1 : 0;
  }
  return outcome;
}

TEST(SupervisedSpeed, ThrowsThroughWhatHeldTheFirstTry) {
  const Machine machine;
  for (const double turns : {1.0, -1.0}) {
    Machine turned = machine;
    turned.turns = turns;
    const Outcome outcome = run(turned, 400.0);
    EXPECT_EQ(outcome.end, Supervision::kNone);
    EXPECT_GE(outcome.retreats, 1) << "the first try is too slow";
    EXPECT_NEAR(outcome.speed, 300.0, 0.1);
    EXPECT_LT(outcome.longest_stay, 3.0 * machine.window());
  }
}

TEST(SupervisedSpeed, GivesUpWhatItCannotPass) {
  Machine machine;
  machine.torque = 0.012;
  machine.tries_what_is_weak = true;
  const Outcome outcome = run(machine, 600.0);
  EXPECT_EQ(outcome.end, Supervision::kGivenUp);
  EXPECT_EQ(outcome.retreats, 3);
  EXPECT_NEAR(outcome.speed, 170.0 - 8.0 * 8.0 / (2.0 * 32.0), 0.1) << "where run-ups begin";
  EXPECT_LT(outcome.longest_stay, 3.0 * machine.window());
}

TEST(SupervisedSpeed, DoesNotTryWhatIsKnownToFail) {
  Machine machine;
  machine.torque = 0.012;
  const Scene scene = machine.scene();
  ASSERT_EQ(scene.controllers[0].weak_passages.size(), 1u);
  const ResonancePassageCheck& weak = scene.controllers[0].weak_passages[0];
  EXPECT_FALSE(weak.tried);
  // c p r^2 with r = e / (2 zeta) at p = 200 rad/s, zeta = 0.005.
  EXPECT_NEAR(weak.needed, 10.0 * 200.0 * std::pow(5e-5 / 0.01, 2), 2e-3 * weak.needed);
  EXPECT_NEAR(weak.speed, 200.0, 1.0);
  EXPECT_EQ(weak.given, 0.012);
  const Outcome outcome = run(machine, 60.0);
  EXPECT_EQ(outcome.end, Supervision::kRefused);
  EXPECT_LT(outcome.furthest, machine.from());
  EXPECT_NEAR(outcome.speed, 170.0 - 8.0 * 8.0 / (2.0 * 32.0), 0.1);
  machine.torque = 0.06;
  EXPECT_TRUE(machine.scene().controllers[0].weak_passages.empty()) << "more than it takes";
}

// Nearly no damping, a bow besides the unbalance, gravity on the shaft, drag, weak and strong
// motors: each passes, aborts or is rejected, and none stays captured.
TEST(SupervisedSpeed, NeverSitsWhateverTheRotor) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>(0.0, 1.0)(random));
  };
  int passed = 0, refused = 0, given_up = 0;
  for (int i = 0; i < 18; ++i) {
    Machine machine;
    machine.critical = between(60.0, 250.0);
    const double p = machine.critical;
    const double full = between(5e-4, 5e-3) * p * p;  // rad/s^2, of the motor
    machine.torque = kInertia * full;
    machine.acceleration = between(0.3, 0.8) * full;
    machine.again = std::max(machine.acceleration, between(0.5, 1.0) * full);
    machine.drag = i % 5 == 0 ? 0.1 * machine.torque / (1.5 * p) : 0.0;
    machine.tries_what_is_weak = i % 2 == 1;
    const double mass = between(1.0, 10.0);
    const bool undamped = i % 3 == 0;
    const double zeta = undamped ? between(1e-7, 1e-4) : between(2e-3, 5e-2);
    // The torque of a steady whirl at p is m p^2 e^2 / (2 zeta).
    const double eccentricity =
        undamped ? between(1e-5, 2e-4)
                 : std::sqrt(2.0 * zeta * machine.torque * between(0.3, 8.0) / (mass * p * p));
    machine.rotor = fmt::format(
        "mass: {}, stiffness: {}, damping: {}, eccentricity: {}, bow: {}, bow_angle: 1.0, "
        "gravity_on_shaft: {}",
        mass, mass * p * p, 2.0 * zeta * mass * p, eccentricity,
        i % 2 == 0 ? 0.0 : 0.3 * eccentricity, i % 4 == 1);
    const Outcome outcome =
        run(machine, 100.0 + 8.0 * (1.5 * p / machine.acceleration + 4.0 * machine.window()));
    SCOPED_TRACE(fmt::format("{}: {} torque {} N m, {} and {} rad/s^2, p {} rad/s", i,
                             machine.rotor, machine.torque, machine.acceleration, machine.again,
                             p));
    EXPECT_LT(outcome.longest_stay, 3.0 * machine.window());
    passed += outcome.end == Supervision::kNone ? 1 : 0;
    refused += outcome.end == Supervision::kRefused ? 1 : 0;
    given_up += outcome.end == Supervision::kGivenUp ? 1 : 0;
    if (outcome.end == Supervision::kNone) {
      EXPECT_NEAR(outcome.speed, machine.target(), 1e-2 * p);
    } else {
      EXPECT_NE(outcome.end, Supervision::kRetreating);
      EXPECT_NE(outcome.end, Supervision::kTryingAgain);
      EXPECT_LT(outcome.speed, machine.from());
    }
  }
  EXPECT_GT(passed, 4);
  EXPECT_GT(refused, 1);
  EXPECT_GT(given_up, 1);
}

}  // namespace supervised_speed_test
}  // namespace whirl_twin
