// A start at the equilibrium: a rotor with gravity hangs in its sag and nothing makes it vibrate,
// until its unbalance or its instability does; any other system starts there where it is asked to.
// References: closed forms, and statics of beams.
#include "scene/equilibrium_start.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "analysis/equilibria.h"
#include "messages/alert.h"
#include "scene/scene_error.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace equilibrium_start_test {

using testing::HasSubstr;

constexpr double kGravity = 9.80665;  // [m/s^2]

/// m = 2 kg, k = 20 kN/m, damping ratio 1e-4: the sag is m g / k = 0.98 mm.
Scene jeffcott(const std::string& more = "", const std::string& system = "") {
  return sceneOf(fmt::format(
      "{{step: 0.001, systems: {{rotor: {{model: jeffcott_rotor, {} parameters: {{mass: 2.0, "
      "stiffness: 2.0e+4, damping: 0.04, gravity_on_shaft: true, speed: 40.0, {} }}}}}}}}",
      system, more));
}

constexpr double kSag = 2.0 * kGravity / 2.0e4;  // g / omega_n^2

AlarmSettings strict(double level) {
  AlarmSettings settings;
  settings.log_decrement_warning = 0.0;
  settings.amplitude["rotor"] = {{}, {level}, {2.0 * level}};
  settings.zones["rotor"] = {0.5 * level, level, 2.0 * level};
  return settings;
}

TEST(EquilibriumStart, AJeffcottRotorWithGravityHangsStillInItsSag) {
  const Scene scene = jeffcott();
  EXPECT_NEAR(scene.systems[0].q[0], 0.0, 1.0e-15);
  EXPECT_NEAR(scene.systems[0].q[1], -kSag, 1.0e-12 * kSag);
  WatchedTwin watched(scene, strict(1.0e-3 * kSag));
  double moved = 0.0;
  for (int i = 0; i < 100; ++i) {
    watched.run(0.1);
    const state::WhirlState& whirl = watched.observer.whirl(0);
    moved = std::max(moved, std::hypot(whirl.x, whirl.y + kSag));
  }
  EXPECT_LT(moved, 1.0e-11 * kSag);
  EXPECT_TRUE(watched.monitor.alerts().active().empty());
}

// Dropped from the line of its bearings it bounces by its sag, and at this damping for hours.
TEST(EquilibriumStart, ARotorThatIsDroppedIsInDangerForever) {
  WatchedTwin dropped(jeffcott("", "initial: {},"), strict(0.1 * kSag));
  WatchedTwin hung(jeffcott(), strict(0.1 * kSag));
  dropped.run(20.0);
  hung.run(20.0);
  EXPECT_NE(dropped.monitor.alerts().find("rotor", alert_type::kWhirlAmplitude), nullptr);
  EXPECT_EQ(hung.monitor.alerts().find("rotor", alert_type::kWhirlAmplitude), nullptr);
}

/// A beam of length L in pins at its ends under q per length: 5 q L^4 / (384 E I), besides m g L^3
/// / (48 E I) of a mass m in the middle (Euler and Bernoulli); Timoshenko's shear is left out.
TEST(EquilibriumStart, AFlexibleRotorHangsStillInTheSagOfABeam) {
  constexpr double kLength = 1.0, kDiameter = 0.02, kModulus = 2.0e11, kDensity = 7800.0;
  const double area = 0.25 * M_PI * kDiameter * kDiameter;
  const double bending = kModulus * M_PI * std::pow(kDiameter, 4) / 64.0;
  const double stiff = 1.0e9;
  const double weight = kGravity * (kDensity * area * kLength + 5.0);
  const double sag = 5.0 * kDensity * area * kGravity * std::pow(kLength, 4) / (384.0 * bending) +
                     5.0 * kGravity * std::pow(kLength, 3) / (48.0 * bending) +
                     0.5 * weight / stiff;
  // Four shapes alone do not know of all of the sag.
  for (const auto& [modes, known] : {std::pair{"0", 1.0e-6}, {"auto", 1.0e-6}, {"4", 1.0e-3}}) {
    SCOPED_TRACE(modes);
    const Scene scene = sceneOf(fmt::format(
        "{{step: 0.001, systems: {{rotor: {{model: flexible_rotor, parameters: {{speed: 30.0, "
        "youngs_modulus: 2.0e+11, density: 7800, shear_deformation: false, gravity_on_shaft: true, "
        "modes: {}, elements: [{{length: 0.125, outer_diameter: 0.02, count: 8}}], "
        "discs: [{{node: 4, mass: 5.0, polar_inertia: 0.01, transverse_inertia: 0.005}}], "
        "bearings: [{{node: 0, kxx: 1.0e+9, kyy: 1.0e+9, cxx: 1.0, cyy: 1.0}}, {{node: 8, kxx: "
        "1.0e+9, kyy: 1.0e+9, cxx: 1.0, cyy: 1.0}}]}}}}}}}}",
        modes));
    WatchedTwin watched(scene, strict(1.0e-3 * sag));
    watched.run(0.1);
    const double y = watched.observer.whirl(0).y;
    EXPECT_NEAR(y, -sag, known * sag);
    watched.run(9.9);
    EXPECT_NEAR(watched.observer.whirl(0).x, 0.0, 1.0e-9 * sag);
    EXPECT_NEAR(watched.observer.whirl(0).y, y, 1.0e-9 * sag);
    EXPECT_EQ(watched.monitor.alerts().find("rotor", alert_type::kWhirlAmplitude), nullptr);
    EXPECT_EQ(watched.monitor.alerts().find("rotor", alert_type::kVibrationZone), nullptr);
  }
}

// The equilibrium of each speed: internal damping turns the sag aside by atan(c_i w / k).
TEST(EquilibriumStart, IsThatOfTheInitialSpeed) {
  const Scene scene = sceneOf(
      "{step: 0.001, drives: {shaft: {speed: 50.0, profile: [{speed: 80.0, max_acceleration: "
      "1.0}]}}, systems: {rotor: {model: jeffcott_rotor, drive: shaft, parameters: {mass: 2.0, "
      "stiffness: 2.0e+4, damping: 40.0, internal_damping: 20.0, gravity_on_shaft: true}}}}");
  const double aside = std::atan2(20.0 * 50.0, 2.0e4);
  const double sag = 2.0 * kGravity / std::hypot(2.0e4, 20.0 * 50.0);
  EXPECT_NEAR(std::fabs(scene.systems[0].q[0]), sag * std::sin(aside), 1.0e-12 * sag);
  EXPECT_NEAR(scene.systems[0].q[1], -sag * std::cos(aside), 1.0e-12 * sag);
}

// The shaft of a motor starts as its drive does; the rotor hangs as at that speed.
TEST(EquilibriumStart, OfARotorOnItsMotorIsThatOfItsSpeed) {
  const Scene scene = sceneOf(
      "{step: 0.001, drives: {m: {speed: 20.0, angle: 0.3, motor: {stall_torque: 5.0, "
      "no_load_speed: 350.0}}}, systems: {rotor: {model: jeffcott_rotor, drive: m, parameters: "
      "{mass: 2.0, stiffness: 2.0e+4, damping: 40.0, polar_inertia: 0.1, gravity_on_shaft: "
      "true}}}}");
  const SystemSpec& rotor = scene.systems[0];
  ASSERT_EQ(rotor.q.size(), 3u);
  EXPECT_NEAR(rotor.q[1], -kSag, 1.0e-12 * kSag);
  EXPECT_EQ(rotor.q[2], 0.3);
  EXPECT_EQ(rotor.v[2], 20.0);
}

constexpr const char* kFilms =
    "gravity_on_shaft: true, journal_bearings: [{node: 0, diameter: 0.03, length: 0.012, "
    "clearance: 4.0e-5, viscosity: 0.02}, {node: 8, diameter: 0.03, length: 0.012, clearance: "
    "4.0e-5, viscosity: 0.02}]";

std::string rotorInFilms(const std::string& modes, double speed, const std::string& initial) {
  return fmt::format(
      "{{step: 0.001, systems: {{rotor: {{model: flexible_rotor, {} parameters: {{speed: {}, "
      "modes: {}, youngs_modulus: 2.1e+11, density: 7850, elements: [{{length: 0.1, "
      "outer_diameter: 0.03, count: 8}}], discs: [{{node: 4, mass: 12.0, polar_inertia: 0.05, "
      "transverse_inertia: 0.03}}], {}}}}}}}}}",
      initial, speed, modes, kFilms);
}

TEST(EquilibriumStart, ARotorInFilmsStartsWhereNothingPullsItOn) {
  for (const char* modes : {"0", "auto"}) {
    for (const double speed : {100.0, 250.0, 700.0}) {  // the threshold is 425 rad/s
      const Scene scene = sceneOf(rotorInFilms(modes, speed, ""));
      const SystemSpec& rotor = scene.systems[0];
      ASSERT_TRUE(rotor.rest.has_value()) << modes << " " << speed;
      const auto n = static_cast<Eigen::Index>(rotor.q.size());
      const Dynamics& dynamics = *rotor.setup->made.dynamics;
      const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(rotor.q.data(), n);
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
      const EvaluationPoint<double> at{0.0, 0.0, speed, 0.0};
      EXPECT_LT(dynamics.residualForce(q, zero, at).norm(),
                1.0e-8 * dynamics.residualForce(zero, zero, at).norm());
    }
  }
}

// At standstill no film carries the journals: it starts in the middle, unless it is to rest.
TEST(EquilibriumStart, WithoutAnEquilibriumIsAtZeroOrAnError) {
  const Scene scene = sceneOf(rotorInFilms("0", 0.0, ""));
  EXPECT_FALSE(scene.systems[0].rest.has_value());
  EXPECT_TRUE(std::all_of(scene.systems[0].q.begin(), scene.systems[0].q.end(),
                          [](double x) { return x == 0.0; }));
  try {
    sceneOf(rotorInFilms("0", 0.0, "initial: equilibrium,"));
    FAIL() << "it was read";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("systems.rotor.initial"));
    EXPECT_THAT(error.what(), HasSubstr("no equilibrium was found at the initial 0 rad/s"));
  }
}

TEST(EquilibriumStart, OtherWordsAreComplainedOf) {
  try {
    jeffcott("", "initial: rest,");
    FAIL() << "it was read";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("or equilibrium, found 'rest'"));
  }
}

// Numbers keep their meaning: what is not given is 0.
TEST(EquilibriumStart, NumbersAreWhatTheySay) {
  const Scene scene = jeffcott("", "initial: {x: 1.0e-4},");
  EXPECT_FALSE(scene.systems[0].rest.has_value());
  EXPECT_EQ(scene.systems[0].q, (std::vector<double>{1.0e-4, 0.0}));
}

/// The first coordinate of a system that is asked to start at its equilibrium.
double restOf(const std::string& system) {
  return sceneOf("{step: 0.001, systems: {s: {initial: equilibrium, " + system + "}}}")
      .systems[0]
      .q[0];
}

// A spinning pendulum hangs; beyond sqrt(g / l), where that is unstable, it swings out to
// acos(g / (l w^2)).
TEST(EquilibriumStart, AnyOtherSystemIsAskedTo) {
  EXPECT_NEAR(restOf("model: spinning_pendulum, parameters: {mass: 0.5, length: 0.2, damping: 0.0, "
                     "speed: 5.0}"),
              0.0, 1.0e-12);
  EXPECT_NEAR(std::fabs(restOf("model: spinning_pendulum, parameters: {mass: 0.5, length: 0.2, "
                               "damping: 0.0, speed: 9.0}")),
              std::acos(kGravity / (0.2 * 81.0)), 1.0e-9);
}

// Each member of an ensemble hangs in the sag of its own stiffness.
TEST(EquilibriumStart, OfAnEnsembleIsThatOfEachMember) {
  const Scene scene = jeffcott("", "count: 20, spread: {stiffness: {relative_half_width: 0.3}},");
  WatchedTwin watched(scene);
  watched.run(1.0);
  const BuiltScene built = build(scene);
  const SystemSpec& given = scene.systems[0];
  for (const double stiffness : {1.5e4, 2.5e4}) {
    SystemSpec member = given;
    member.parameters["stiffness"] = stiffness;
    member.parameters["stiffness_y"] = stiffness;
    const ModelInfo& model = *built.systems[0]->model;
    const ModelSetup setup = model.setUp(member.parameters, member.settings, {kGravity});
    const auto own = equilibriumStart(model, member, setup, {kGravity}, given.rest->speed);
    moveToEquilibrium(given, own, {kGravity}, member);
    EXPECT_NEAR(member.q[1], -2.0 * kGravity / stiffness, 1.0e-15);
  }
}

}  // namespace equilibrium_start_test
}  // namespace whirl_twin
