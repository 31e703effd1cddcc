// What a spread of a system's numbers does to its stability, beside closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/characteristic_polynomial.h"
#include "analysis/equilibria.h"
#include "analysis/routh.h"
#include "monitoring/parameter_margins.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace robust_stability_margin_test {

/// A rotor of 1 kg and 1e4 N/m at 150 rad/s, damped by 10 N s/m from outside: stable up to an
/// internal damping of 20 N s/m.
std::string selfExcited(double internal_damping, const std::string& spread) {
  return R"(
step: 0.001
drives: {shaft: {speed: 150.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: )" +
         std::to_string(internal_damping) + "}\n" + spread;
}

struct Known {
  explicit Known(const std::string& yaml) : scene(build(sceneOf(yaml))) {
    const BuiltSystem& system = *scene.systems[0];
    speed = scene.driveOf(system).at(0.0).speed;
    const auto n = static_cast<Eigen::Index>(system.spec.q.size());
    const auto point =
        operatingPoint(*system.dynamics, Eigen::Map<const Eigen::VectorXd>(system.spec.q.data(), n),
                       Eigen::VectorXd::Zero(n), speed);
    motion = {point.value().q, point.value().v};
    margin = robustStabilityMargin(system, motion, speed);
  }
  /// [1/s], with these numbers, by eigenvalues of their own.
  double decayAt(const std::vector<std::string>& names, const std::vector<double>& values) const {
    const SharedSystem changed = scene.systems[0]->with(names, values, "test");
    const auto roots =
        eigenvalues(linearizationAbout(*changed->dynamics, motion.q, motion.v, speed));
    double fastest = -1.0e300;
    for (const auto& root : roots) {
      fastest = std::max(fastest, root.real());
    }
    return -fastest;
  }

  BuiltScene scene;
  double speed = 0.0;
  SteadyMotion motion;
  std::optional<RobustStabilityMargin> margin;
};

TEST(RobustStabilityMargin, CountsTheMembersBeyondTheThresholdAndFindsTheWorstEndOfTheBox) {
  const Known uniform(selfExcited(18.0, "    spread: {internal_damping: {half_width: 4.0}}\n"));
  ASSERT_TRUE(uniform.margin);
  EXPECT_EQ(uniform.margin->decay_rates.size(), 1000u);
  // From 14 to 22, beyond 20 a quarter, to within four deviations.
  EXPECT_NEAR(static_cast<double>(uniform.margin->beyond(0.0)), 250.0, 55.0);
  EXPECT_NEAR(uniform.margin->lowest_decay_rate, uniform.decayAt({"internal_damping"}, {22.0}),
              1.0e-9);
  EXPECT_LT(uniform.margin->lowest_decay_rate, 0.0);
  EXPECT_FALSE(uniform.margin->stable_throughout);

  const Known normal(
      selfExcited(18.0, "    spread: {internal_damping: {standard_deviation: 2.0}}\n"));
  ASSERT_TRUE(normal.margin);
  const double part = 0.5 * std::erfc(1.0 / std::sqrt(2.0));  // beyond one deviation
  EXPECT_NEAR(static_cast<double>(normal.margin->beyond(0.0)), 1000.0 * part, 47.0);
  EXPECT_LE(normal.margin->lowest_decay_rate, normal.decayAt({"internal_damping"}, {24.0}) + 1e-9);
}

TEST(RobustStabilityMargin, CountsAgainstADecayRateTheUserAsksFor) {
  const Known known(selfExcited(10.0, "    spread: {internal_damping: {half_width: 4.0}}\n"));
  ASSERT_TRUE(known.margin);
  EXPECT_EQ(known.margin->beyond(0.0), 0u);
  const double middle = known.decayAt({"internal_damping"}, {10.0});
  EXPECT_NEAR(static_cast<double>(known.margin->beyond(middle)), 500.0, 64.0);
  EXPECT_EQ(known.margin->beyond(2.0 * known.margin->decay_rates.back()), 1000u);
}

// Each for itself may be unstable: internal damping beyond twice the damping. Together they go as
// twice one is the other, and never are.
TEST(RobustStabilityMargin, OfNumbersThatGoTogetherIsThatOfWhatTheyCanBe) {
  const std::string apart =
      "    spread:\n      damping: {standard_deviation: 2.0}\n      internal_damping: "
      "{standard_deviation: 4.0}\n";
  const Known loose(selfExcited(18.0, apart));
  ASSERT_TRUE(loose.margin);
  // 2 damping - internal_damping: 2 with a deviation of 5.66.
  EXPECT_NEAR(static_cast<double>(loose.margin->beyond(0.0)), 362.0, 61.0);
  const Known tied(
      selfExcited(18.0, apart + "      correlations: [[damping, internal_damping, 0.999]]\n"));
  ASSERT_TRUE(tied.margin);
  EXPECT_EQ(tied.margin->beyond(0.0), 0u);
  // Of the slanted box the end at which both are three deviations down, and the rest is.
  EXPECT_GT(tied.margin->lowest_decay_rate, 0.0);
  EXPECT_LT(tied.margin->lowest_decay_rate,
            tied.decayAt({"damping", "internal_damping"}, {4.0, 6.0}) + 1.0e-9);
}

// The decay of an oscillator with this damper is slowest where damping is least and mass largest.
TEST(RobustStabilityMargin, OfOneCoordinateKharitonovTellsOfTheWholeBox) {
  const auto oscillator = [](double half_width) {
    return Known(R"(
step: 0.001
systems:
  swing:
    model: linear_system
    parameters: {mass: [[1.0]], damping: [[0.4]], stiffness: [[100.0]]}
    spread:
      damping[0][0]: {half_width: )" +
                 std::to_string(half_width) + R"(}
      stiffness[0][0]: {relative_half_width: 0.2}
)");
  };
  const Known known = oscillator(0.1);
  ASSERT_TRUE(known.margin);
  EXPECT_TRUE(known.margin->stable_throughout);
  EXPECT_NEAR(known.margin->lowest_decay_rate, 0.15, 1.0e-9);
  const Known wider = oscillator(0.5);
  ASSERT_TRUE(wider.margin);
  EXPECT_FALSE(wider.margin->stable_throughout);
  EXPECT_NEAR(wider.margin->lowest_decay_rate, -0.05, 1.0e-9);
}

// Of more coordinates the four polynomials are of no rotor: where they grow, they tell nothing.
// Where they decay, so does every member.
TEST(RobustStabilityMargin, ABoxThatKharitonovCallsStableHasNoMemberThatGrows) {
  for (const double width : {0.001, 0.01, 0.05, 0.2, 0.5}) {
    const Known known(selfExcited(
        10.0, "    spread: {internal_damping: {relative_half_width: " + std::to_string(width) +
                  "}, stiffness: {relative_half_width: " + std::to_string(width) +
                  "}, damping: {relative_half_width: " + std::to_string(width) + "}}\n"));
    ASSERT_TRUE(known.margin) << width;
    if (known.margin->stable_throughout) {
      EXPECT_EQ(known.margin->beyond(0.0), 0u) << width;
      EXPECT_GT(known.margin->lowest_decay_rate, 0.0) << width;
    }
    if (width == 0.001) {
      EXPECT_TRUE(known.margin->stable_throughout);
    }
    if (width == 0.5) {
      EXPECT_FALSE(known.margin->stable_throughout);
      EXPECT_LT(known.margin->lowest_decay_rate, 0.0) << "twice its share of the outer damping";
    }
  }
}

/// Do all corners of a box of coefficients decay? Kharitonov's four are enough by his theorem.
bool allCornersDecay(const std::vector<double>& low, const std::vector<double>& high) {
  for (std::size_t corner = 0; corner < std::size_t{1} << low.size(); ++corner) {
    std::vector<double> polynomial;
    for (std::size_t k = 0; k < low.size(); ++k) {
      polynomial.push_back((corner >> k & 1U) != 0 ? high[k] : low[k]);
    }
    if (routh(polynomial).verdict != Verdict::kAsymptoticallyStable) {
      return false;
    }
  }
  return true;
}

TEST(RobustStabilityMargin, FourPolynomialsTellWhatAllCornersOfTheCoefficientsTell) {
  int stable = 0, not_told = 0;
  for (double width = 0.002; width < 0.4; width *= 1.15) {
    const std::string part = std::to_string(width);
    const Known known(selfExcited(10.0, "    spread: {damping: {relative_half_width: " + part +
                                            "}, stiffness: {relative_half_width: " + part +
                                            "}}\n"));
    ASSERT_TRUE(known.margin);
    std::vector<double> low, high;
    for (const double damping : {1.0 - width, 1.0 + width}) {
      for (const double stiffness : {1.0 - width, 1.0 + width}) {
        const SharedSystem corner = known.scene.systems[0]->with(
            {"damping", "damping_y", "stiffness", "stiffness_y"},
            {10.0 * damping, 10.0 * damping, 1.0e4 * stiffness, 1.0e4 * stiffness}, "test");
        std::vector<double> polynomial;
        for (const Rational& c : characteristicPolynomial(linearizationAbout(
                 *corner->dynamics, known.motion.q, known.motion.v, known.speed))) {
          polynomial.push_back(c.convert_to<double>());
        }
        low = low.empty() ? polynomial : low;
        high = high.empty() ? polynomial : high;
        for (std::size_t k = 0; k < polynomial.size(); ++k) {
          low[k] = std::min(low[k], polynomial[k]);
          high[k] = std::max(high[k], polynomial[k]);
        }
      }
    }
    EXPECT_EQ(known.margin->stable_throughout, allCornersDecay(low, high)) << width;
    (known.margin->stable_throughout ? stable : not_told) += 1;
  }
  EXPECT_GT(stable, 3);
  EXPECT_GT(not_told, 3);
}

// An isotropic rotor is the least stable: the slowest decay lies at stiffness_y = stiffness,
// inside, and at the ends of the damping. A thousand members do not come near both.
TEST(RobustStabilityMargin, TheSlowestDecayIsFoundBetweenTheCornersToo) {
  const Known known(R"(
step: 0.001
drives: {shaft: {speed: 150.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters:
      {mass: 1.0, stiffness: 1.0e4, stiffness_y: 1.03e4, damping: 1.0, internal_damping: 1.4}
    spread:
      stiffness_y: {half_width: 1000.0}
      damping: {half_width: 0.1}
      damping_y: {half_width: 0.1}
      internal_damping: {half_width: 0.2}
)");
  ASSERT_TRUE(known.margin);
  const std::vector<std::string> numbers = {"stiffness_y", "damping", "damping_y",
                                            "internal_damping"};
  double slowest = 1.0e300;
  for (double k = 9300.0; k <= 11300.0; k += 5.0) {
    slowest = std::min(slowest, known.decayAt(numbers, {k, 0.9, 0.9, 1.6}));
  }
  const double at_corners = std::min(known.decayAt(numbers, {9300.0, 0.9, 0.9, 1.6}),
                                     known.decayAt(numbers, {11300.0, 0.9, 0.9, 1.6}));
  ASSERT_GT(at_corners - slowest, 0.05) << "else nothing is tested";
  ASSERT_GT(known.margin->decay_rates.front() - slowest, 0.002) << "likewise";
  EXPECT_NEAR(known.margin->lowest_decay_rate, slowest, 0.001);
}

TEST(RobustStabilityMargin, WithoutANumberOfTheModelThereIsNothingToTell) {
  EXPECT_FALSE(Known(selfExcited(10.0, "    spread: {initial.x: {half_width: 1.0e-4}}\n")).margin);
  EXPECT_FALSE(Known(selfExcited(10.0, "")).margin);
}

TEST(RobustStabilityMargin, TheMonitorWarnsOfAThresholdWithinTheSpreadUntilTheNumbersLeaveIt) {
  WatchedTwin watched(
      sceneOf(selfExcited(18.0, "    spread: {internal_damping: {half_width: 4.0}}\n")));
  watched.run(0.15);
  const state::StabilityMargin& margin = watched.margins.back();
  EXPECT_EQ(margin.verdict_name, "asymptotically_stable");
  EXPECT_EQ(margin.members, 1000u);
  EXPECT_GT(margin.members_beyond, 100u);
  EXPECT_LT(margin.lowest_decay_rate, 0.0);
  EXPECT_EQ(watched.count("UNSTABLE_WITHIN_SPREAD", true), 1u);
  EXPECT_EQ(watched.count("UNSTABLE", true), 0u);

  state::ParameterChange change = watched.observer.parameters(0);
  const auto place = std::find(change.names.begin(), change.names.end(), "internal_damping");
  change.values[static_cast<std::size_t>(place - change.names.begin())] = 10.0;
  ASSERT_TRUE(watched.monitor.take(change));
  watched.run(1.5);
  EXPECT_EQ(watched.margins.back().members_beyond, 0u);
  EXPECT_GT(watched.margins.back().lowest_decay_rate, 0.0);
  EXPECT_EQ(watched.count("UNSTABLE_WITHIN_SPREAD", false), 1u);
}

TEST(RobustStabilityMargin, TheAlarmActsOnTheBoundOrOnTheMembersAsItIsSet) {
  const std::string yaml = selfExcited(18.0, "    spread: {internal_damping: {half_width: 4.0}}\n");
  AlarmSettings settings;
  settings.members_beyond = 0.5;
  settings.lowest_decay_rate = -1.0e3;
  WatchedTwin lenient(sceneOf(yaml), settings);
  lenient.run(0.15);
  EXPECT_EQ(lenient.count("UNSTABLE_WITHIN_SPREAD", true), 0u);
  settings.decay_rate_alarm = 1.0;  // slower than that decay some more
  WatchedTwin slow(sceneOf(yaml), settings);
  slow.run(0.15);
  EXPECT_GT(slow.margins.back().members_beyond, lenient.margins.back().members_beyond);
  settings.decay_rate_alarm = 0.0;
  settings.lowest_decay_rate = 0.0;
  WatchedTwin bound(sceneOf(yaml), settings);
  bound.run(0.15);
  EXPECT_EQ(bound.count("UNSTABLE_WITHIN_SPREAD", true), 1u);
}

TEST(RobustStabilityMargin, AnEnsembleIsJudgedByItsMembersThatRun) {
  WatchedTwin watched(sceneOf(
      selfExcited(18.0, "    count: 5\n    spread: {internal_damping: {half_width: 4.0}}\n")));
  watched.run(0.15);
  EXPECT_EQ(watched.margins.back().members, 0u);
  EXPECT_EQ(watched.count("UNSTABLE_WITHIN_SPREAD", true), 0u);
}

}  // namespace robust_stability_margin_test
}  // namespace whirl_twin
