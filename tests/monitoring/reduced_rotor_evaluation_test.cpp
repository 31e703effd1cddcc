// A rotor reduced to a few shapes is judged with what the reduction has changed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "algebra/constants.h"
#include "analysis/equilibria.h"
#include "messages/alert.h"
#include "monitoring/stability_alarm.h"
#include "monitoring/stability_evaluator.h"
#include "scene/built_scene.h"

namespace whirl_twin {
namespace reduced_rotor_evaluation_test {

constexpr const char* kShaft =
    "youngs_modulus: 211.0e+9, shear_modulus: 81.2e+9, density: 7810, elements: [{length: 0.25, "
    "outer_diameter: 0.05, count: 6}], discs: [{node: 2, mass: 32.59, polar_inertia: 0.3296, "
    "transverse_inertia: 0.1781}, {node: 4, mass: 51.53, polar_inertia: 0.8051, "
    "transverse_inertia: 0.4236}]";
/// Driven by its own damping above some 400 rad/s.
constexpr const char* kDriven =
    "internal_damping: 2.0e-5, bearings: [{node: 0, kxx: 1.0e+6, kyy: 1.0e+6, cxx: 100, cyy: 100}, "
    "{node: 6, kxx: 1.0e+6, kyy: 1.0e+6, cxx: 100, cyy: 100}]";
/// In bearings that its journals hardly move in: shapes of the rotor without damping do not know.
constexpr const char* kHeldByDamping =
    "internal_damping: 2.0e-5, bearings: [{node: 0, kxx: 1.0e+6, kyy: 1.0e+6, cxx: 3000, cyy: "
    "3000}, {node: 6, kxx: 1.0e+6, kyy: 1.0e+6, cxx: 3000, cyy: 3000}]";

BuiltScene rotorIn(const std::string& modes, const std::string& more, double speed = 100.0) {
  return build(sceneOf(
      fmt::format("{{step: 0.001, systems: {{r: {{model: flexible_rotor, parameters: {{speed: {}, "
                  "modes: {}, {}, {}}}}}}}}}",
                  speed, modes, kShaft, more)));
}

state::StabilityMargin judged(const BuiltScene& scene, double speed) {
  const std::vector<double> rest(static_cast<std::size_t>(scene.systems[0]->dynamics->dof()), 0.0);
  return StabilityEvaluator(scene.systems[0]).evaluate({1, 0.001, 0}, rest, rest, speed);
}

// Damping C = alpha M damps a mode w_i by zeta_i = alpha / (2 w_i): the less the higher it is, and
// least those of the mesh. A uniform shaft between pins has w_i = i^2 w_1; its second modes are the
// last below twice the fourth whirl, the second in the other plane.
TEST(RotorJudge, AsksDampingOfTheLowestWhirlsAndNotOfItsMesh) {
  const double d = 0.02, length = 1.0, alpha = 200.0;
  const double first = kPi * kPi * std::sqrt(2.1e11 * d * d / 16.0 / 7850.0) / (length * length);
  const double zeta = alpha / (2.0 * 4.0 * first);
  const BuiltScene scene = build(sceneOf(fmt::format(
      "{{step: 0.001, systems: {{r: {{model: flexible_rotor, parameters: {{speed: 10, modes: 0, "
      "youngs_modulus: 2.1e+11, density: 7850, shear_deformation: false, mass_damping: {}, "
      "elements: [{{length: {}, outer_diameter: {}, count: 12}}], bearings: [{{node: 0, pin: "
      "true}}, "
      "{{node: 12, pin: true}}]}}}}}}}}",
      alpha, length / 12.0, d)));
  const state::StabilityMargin margin = judged(scene, 10.0);
  EXPECT_EQ(margin.verdict_name, "asymptotically_stable");
  EXPECT_NEAR(margin.damping_ratio, zeta, 0.01 * zeta);
  EXPECT_NEAR(margin.log_decrement, 2.0 * kPi * zeta / std::sqrt(1.0 - zeta * zeta), 0.01 * zeta);
  // A shaft that turns faster than the third modes has them asked, too.
  EXPECT_NEAR(judged(scene, 12.0 * first).damping_ratio, zeta * 4.0 / 9.0, 0.01 * zeta);
}

/// A speed above which the rotor is unstable.
double thresholdOf(const BuiltScene& scene) {
  double stable = 50.0;
  double unstable = 20000.0;
  while (unstable - stable > 1.0e-6) {
    const double middle = 0.5 * (stable + unstable);
    (judged(scene, middle).decay_rate > 0.0 ? stable : unstable) = middle;
  }
  return stable;
}

/// Judges a rotor in so few shapes at a speed between its threshold and theirs.
void expectDoubtBetweenThresholds(const std::string& modes, const char* bearings,
                                  bool shapes_are_stable) {
  SCOPED_TRACE(modes + " modes, " + bearings);
  const BuiltScene whole = rotorIn("0", bearings);
  const BuiltScene few = rotorIn(modes, bearings);
  const double of_whole = thresholdOf(whole);
  const double of_few = thresholdOf(few);
  ASSERT_EQ(of_few > of_whole, shapes_are_stable);
  ASSERT_GT(std::fabs(of_few - of_whole), 1.0e-2 * of_whole);
  const double between = 0.5 * (of_whole + of_few);
  const state::StabilityMargin truth = judged(whole, between);
  ASSERT_EQ(truth.verdict_name, shapes_are_stable ? "unstable" : "asymptotically_stable");
  const state::StabilityMargin margin = judged(few, between);
  EXPECT_EQ(margin.verdict_name, "uncertain");
  EXPECT_TRUE(margin.reduction_disagrees);
  EXPECT_EQ(margin.decay_rate > 0.0, shapes_are_stable);
  EXPECT_NEAR(margin.unreduced_decay_rate, truth.decay_rate, 1.0e-7);
  EXPECT_EQ(margin.unreduced_log_decrement < 0.0, shapes_are_stable);

  StabilityAlarm alarm("r", AlarmSettings{});
  AlertList alerts;
  alarm.update(margin, alerts);
  const state::Alert* const alert = alerts.find("r", alert_type::kUnstable);
  ASSERT_NE(alert, nullptr);
  EXPECT_EQ(alert->severity, state::Severity::kWarning);
  EXPECT_NE(alert->text.find("retain more modes"), std::string::npos) << alert->text;

  const state::StabilityMargin below = judged(few, 0.9 * std::min(of_whole, of_few));
  EXPECT_EQ(below.verdict_name, "asymptotically_stable");
  EXPECT_FALSE(below.reduction_disagrees);
  const state::StabilityMargin above = judged(few, 1.1 * std::max(of_whole, of_few));
  EXPECT_EQ(above.verdict_name, "unstable");
  EXPECT_FALSE(above.reduction_disagrees);
}

TEST(ReducedRotorJudge, IsNotSureOfAStabilityThatItsFewShapesAloneHave) {
  expectDoubtBetweenThresholds("2", kHeldByDamping, true);
  expectDoubtBetweenThresholds("4", kHeldByDamping, true);
}

TEST(ReducedRotorJudge, IsNotSureOfAGrowthThatItsFewShapesAloneHave) {
  expectDoubtBetweenThresholds("2", kDriven, false);
  expectDoubtBetweenThresholds("4", kDriven, false);
}

// Two shapes cannot whirl in a second mode, which is what grows first here.
TEST(ReducedRotorJudge, KnowsOfMotionsThatTheShapesHaveNoPartIn) {
  constexpr const char* kSeal =
      "bearings: [{node: 0, kxx: 1.0e+6, kyy: 1.0e+6, cxx: 100, cyy: 100}, {node: 6, kxx: 1.0e+6, "
      "kyy: 1.0e+6, cxx: 100, cyy: 100}, {node: 5, kxx: 0.0, kyy: 0.0, kxy: 4.0e+4, kyx: -4.0e+4, "
      "cxx: 10, cyy: 10}]";
  const state::StabilityMargin whole = judged(rotorIn("0", kSeal), 100.0);
  ASSERT_EQ(whole.verdict_name, "unstable");
  const state::StabilityMargin few = judged(rotorIn("2", kSeal), 100.0);
  EXPECT_NE(few.verdict_name, "asymptotically_stable");
  EXPECT_NEAR(few.unreduced_decay_rate, whole.decay_rate, 1.0e-6 * std::fabs(whole.decay_rate));
}

TEST(ReducedRotorJudge, IsOfOneMindWithTheRotorWhereItsShapesAreEnough) {
  const BuiltScene enough = rotorIn("auto", kDriven);
  for (const double speed : {20.0, 150.0, 300.0, 450.0}) {
    const state::StabilityMargin margin = judged(enough, speed);
    EXPECT_FALSE(margin.reduction_disagrees) << speed;
    EXPECT_NEAR(margin.unreduced_decay_rate, margin.decay_rate,
                1.0e-5 * std::fabs(margin.decay_rate))
        << speed;
  }
}

// A stiff rotor that turns far below all of its whirls: the lowest of them counts all the same.
TEST(ReducedRotorJudge, KnowsTheDampingOfARotorFarBelowItsWhirls) {
  constexpr const char* kUndamped =
      "bearings: [{node: 0, kxx: 1.0e+6, kyy: 1.0e+6, cxx: 0.1, cyy: 0.1}, {node: 6, kxx: 1.0e+6, "
      "kyy: 1.0e+6, cxx: 0.1, cyy: 0.1}]";
  const BuiltScene slow = rotorIn("8", std::string(kUndamped) + ", highest_speed: 20", 10.0);
  const state::StabilityMargin margin = judged(slow, 10.0);
  EXPECT_NEAR(margin.unreduced_decay_rate, margin.decay_rate, 0.02 * margin.decay_rate);
  EXPECT_NEAR(margin.unreduced_log_decrement, margin.log_decrement, 0.02 * margin.log_decrement);
  StabilityAlarm alarm("r", AlarmSettings{});
  AlertList alerts;
  alarm.update(margin, alerts);
  EXPECT_NE(alerts.find("r", alert_type::kLowDamping), nullptr);
}

// What stands in films rests elsewhere in few shapes, and is as stiff and as damped as there.
TEST(ReducedRotorJudge, JudgesFilmsWhereTheRotorItselfRests) {
  constexpr const char* kFilms =
      "gravity_on_shaft: true, journal_bearings: [{node: 0, diameter: 0.05, length: 0.03, "
      "clearance: 1.0e-4, viscosity: 0.02}, {node: 6, diameter: 0.05, length: 0.03, clearance: "
      "1.0e-4, viscosity: 0.02}]";
  for (const double speed : {100.0, 250.0, 400.0}) {
    const BuiltScene whole = rotorIn("0", kFilms);
    const Dynamics& dynamics = *whole.systems[0]->dynamics;
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(dynamics.dof());
    const auto point = operatingPoint(dynamics, rest, rest, speed);
    ASSERT_TRUE(point.has_value()) << speed;
    const BuiltScene few = rotorIn("10", kFilms);
    // Of all its motions within what the reduction was made for: bending beyond decays slower.
    const double reach = std::max(few.systems[0]->dynamics->linearRotor().highest_speed, speed);
    ASSERT_TRUE(std::isfinite(reach));
    double decay_rate = kInfinity;
    double damping_ratio = kInfinity;
    int within = 0;
    for (const auto& root : point->stability.eigenvalues) {
      if (std::abs(root) <= reach) {
        decay_rate = std::min(decay_rate, -root.real());
        damping_ratio = std::min(damping_ratio, -root.real() / std::abs(root));
        ++within;
      }
    }
    ASSERT_GT(within, 2) << speed;
    const state::StabilityMargin margin = judged(few, speed);
    EXPECT_NEAR(margin.unreduced_decay_rate, decay_rate, 1.0e-6 * std::fabs(decay_rate) + 1.0e-7)
        << speed;
    EXPECT_NEAR(margin.unreduced_log_decrement,
                2.0 * M_PI * damping_ratio / std::sqrt(1.0 - damping_ratio * damping_ratio), 1.0e-6)
        << speed;
  }
}

// The spin of a motor's shaft is a state; what the reduction changes is in the whirl at that spin.
TEST(ReducedRotorJudge, OnAMotorJudgesTheRotorAtTheSpeedOfItsShaft) {
  const BuiltScene scene = build(sceneOf(fmt::format(
      "{{step: 0.001, drives: {{m: {{motor: {{stall_torque: 5.0, no_load_speed: 350.0}}}}}}, "
      "systems: {{r: {{model: flexible_rotor, drive: m, parameters: {{modes: 4, {}, {}}}}}}}}}",
      kShaft, kDriven)));
  std::vector<double> q(5, 0.0);
  std::vector<double> v(5, 0.0);
  v.back() = 350.0;
  const state::StabilityMargin margin =
      StabilityEvaluator(scene.systems[0]).evaluate({1, 0.001, 0}, q, v, 350.0);
  const state::StabilityMargin held = judged(rotorIn("0", kDriven), 350.0);
  EXPECT_FALSE(margin.reduction_disagrees);
  EXPECT_NEAR(margin.unreduced_decay_rate, held.decay_rate, 1.0e-6);
  EXPECT_NEAR(margin.unreduced_log_decrement, held.log_decrement, 1.0e-6);
}

TEST(ReducedRotorJudge, SaysNothingOfWhatIsNotReduced) {
  const state::StabilityMargin margin = judged(rotorIn("0", kDriven), 100.0);
  EXPECT_TRUE(std::isnan(margin.unreduced_decay_rate));
  EXPECT_TRUE(std::isnan(margin.unreduced_log_decrement));
  EXPECT_FALSE(margin.reduction_disagrees);
}

}  // namespace reduced_rotor_evaluation_test
}  // namespace whirl_twin
