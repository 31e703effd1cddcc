// Known optima: from theory, or because no point of a fine grid is better.
#include "studies/optimizer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "messages/input_error.h"
#include "studies/study_reader.h"
#include "study_files.h"

namespace whirl_twin {
namespace optimizer_test {

const std::atomic<bool> kNever{false};

Optimum optimumOf(const Study& study) {
  return optimize(study, chooseSteps(study), kNever, [](std::uint64_t) {});
}

/// The measure to be optimized, at a point.
double measureAt(const Study& study, const std::vector<double>& values) {
  const StepsChosen steps = chooseSteps(study);
  PointEvaluator evaluator(study, steps, kNever);
  return evaluator.at(values).measures.at(study.optimization->measure);
}

// The slowest motion of m x'' + c x' + k x = 0 dies out fastest where it just does not swing:
// c = 2 sqrt(k m) = 200 N s/m, at p = 100 1/s.
TEST(Optimizer, TheLargestDecayRateIsThatOfCriticalDamping) {
  const StudyFiles files;
  for (const std::string method : {"cobyla", "crs", "isres"}) {
    const Study study = readStudy(files.study(R"(
vary: {rotor.damping: {uniform: [1.0, 500.0]}}
run: {analyze: true, speed: 0.0}
measure: {decay: margins.decay_rate}
optimize: {maximize: decay, tolerance: 1.0e-5, evaluations: 3000, method: )" +
                                              method + "}\n"));
    const Optimum optimum = optimumOf(study);
    ASSERT_FALSE(optimum.values.empty()) << method << ": " << optimum.ended;
    EXPECT_EQ(optimum.start[0], 10.0);
    EXPECT_NEAR(optimum.at_start.measures[0], 5.0, 1e-9);
    EXPECT_NEAR(optimum.values[0], 200.0, 0.5) << method;
    EXPECT_NEAR(optimum.measures[0], 100.0, 2.0) << method;  // steep: sqrt(c - 200) beyond
  }
}

// Over damping and stiffness that rate is sqrt(k/m) at best, along c = 2 sqrt(k m), a ridge on
// which a quadratic or a plane has no direction to go. Either the search gets to its end, 100 1/s
// at k = 1e4 N/m, or it does not claim to have converged.
TEST(Optimizer, OnARidgeItDoesNotClaimToHaveConverged) {
  const StudyFiles files;
  for (const std::string method : {"bobyqa", "cobyla"}) {
    const Study study = readStudy(files.study(R"(
vary: {rotor.damping: {uniform: [1.0, 500.0]}, rotor.stiffness: {uniform: [1.0e+3, 1.0e+4]}}
run: {analyze: true, speed: 0.0}
measure: {decay: margins.decay_rate}
optimize: {maximize: decay, evaluations: 3000, method: )" +
                                              method + "}\n"));
    const Optimum optimum = optimumOf(study);
    ASSERT_FALSE(optimum.values.empty()) << method << ": " << optimum.ended;
    EXPECT_TRUE(!optimum.converged || optimum.measures[0] > 98.0)
        << method << ": " << optimum.measures[0] << ", " << optimum.ended;
    EXPECT_GT(optimum.measures[0], 80.0) << method;
  }
}

// The slowest run-up that keeps an amplitude: the requirement is met to its edge, and a run-up a
// little slower does not meet it.
TEST(Optimizer, TheSlowestRunUpWithinAnAmplitudeIsAtItsEdge) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {shaft.max_acceleration: {uniform: [20.0, 400.0]}}
run: {duration: 6.0}
measure: {rate: shaft.max_acceleration, peak: max(rotor.whirl.radius)}
require: {peak: "< 6.0e-4"}
optimize: {minimize: rate, over: [shaft.max_acceleration]}
)"));
  const Optimum optimum = optimumOf(study);
  ASSERT_FALSE(optimum.values.empty()) << optimum.ended;
  EXPECT_TRUE(optimum.converged) << optimum.ended;
  EXPECT_LT(optimum.measures[1], 6.0e-4);
  EXPECT_GT(optimum.measures[1], 5.97e-4);
  const StepsChosen steps = chooseSteps(study);
  PointEvaluator evaluator(study, steps, kNever);
  EXPECT_GT(evaluator.at({0.99 * optimum.values[0]}).measures[1], 6.0e-4);
}

// A run-up that passes its critical speed in any case: no stiffness and damping of a fine grid has
// a smaller peak, and the same search finds the same.
TEST(Optimizer, TheSmallestPeakIsBelowThatOfAFineGrid) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {rotor.stiffness: {log_uniform: [0.5e4, 2.0e4]}, rotor.damping: {uniform: [5, 30]}}
run: {duration: 2.5}
measure: {peak: max(rotor.whirl.radius)}
optimize: {minimize: peak, method: bobyqa}
)"));
  const Optimum optimum = optimumOf(study);
  ASSERT_FALSE(optimum.values.empty()) << optimum.ended;
  EXPECT_LT(optimum.measures[0], optimum.at_start.measures[0]);
  EXPECT_EQ(measureAt(study, optimum.values), optimum.measures[0]);
  const StepsChosen steps = chooseSteps(study);
  PointEvaluator evaluator(study, steps, kNever);
  double least = INFINITY;
  for (int i = 0; i <= 20; ++i) {
    for (const double damping : {5.0, 10.0, 20.0, 30.0}) {
      const double stiffness = 0.5e4 * std::pow(4.0, i / 20.0);
      least = std::min(least, evaluator.at({stiffness, damping}).measures[0]);
    }
  }
  EXPECT_LT(optimum.measures[0], least * 1.001);
  const Optimum again = optimumOf(study);
  EXPECT_EQ(again.values, optimum.values);
  EXPECT_EQ(again.evaluations, optimum.evaluations);
}

// Two discs with unknown unbalances, two masses to set: the masses that cancel them over all speeds
// of a run-up are opposite to them.
TEST(Optimizer, BalancesOverAllSpeedsOfARunUp) {
  const StudyFiles files;
  files.write("discs.yaml", R"(
name: discs
step: 0.001
drives: {shaft: {speed: 40.0, profile: [{speed: 120.0, max_acceleration: 60.0}]}}
systems:
  rotor:
    model: flexible_rotor
    drive: shaft
    parameters:
      youngs_modulus: 211.0e+9
      density: 7810.0
      elements: [{length: 0.25, outer_diameter: 0.05, count: 6}]
      discs:
        - {node: 2, mass: 32.6, polar_inertia: 0.33, transverse_inertia: 0.18}
        - {node: 4, mass: 51.5, polar_inertia: 0.81, transverse_inertia: 0.42}
      bearings: [{node: 0, kxx: 1.0e+6, cxx: 1000.0}, {node: 6, kxx: 1.0e+6, cxx: 1000.0}]
      unbalances:
        - {node: 2, magnitude: 2.0e-4, angle: 3.0}
        - {node: 4, magnitude: 2.0e-4, angle: 1.0}
        - {node: 2, magnitude: 6.0e-4, angle: 0.9}
        - {node: 4, magnitude: 9.0e-4, angle: 3.6}
      stations: [{node: 1}, {node: 5}]
      modes: 12
      highest_speed: 150.0
)");
  const Study study = readStudy(files.write("balance.yaml", R"(
study: {scene: discs.yaml}
vary:
  rotor.unbalances[0].magnitude: {uniform: [0.0, 2.0e-3]}
  rotor.unbalances[0].angle: {uniform: [0.0, 6.2832]}
  rotor.unbalances[1].magnitude: {uniform: [0.0, 2.0e-3]}
  rotor.unbalances[1].angle: {uniform: [-3.1416, 3.1416]}
run: {duration: 2.0}
measure: {whirl: 1.0e8 * (rms(rotor_node_1.whirl.radius)^2 + rms(rotor_node_5.whirl.radius)^2)}
optimize: {minimize: whirl, method: bobyqa, tolerance: 1.0e-4}
)"));
  const Optimum optimum = optimumOf(study);
  ASSERT_FALSE(optimum.values.empty()) << optimum.ended;
  EXPECT_NEAR(optimum.values[0], 6.0e-4, 0.6e-5) << optimum.ended << optimum.evaluations;
  EXPECT_NEAR(optimum.values[1], 0.9 + 3.14159265, 0.02);
  EXPECT_NEAR(optimum.values[2], 9.0e-4, 0.9e-5);
  EXPECT_NEAR(optimum.values[3], 3.6 - 3.14159265, 0.02);
  EXPECT_LT(optimum.measures[0], 1.0e-3 * optimum.at_start.measures[0]);
}

TEST(Optimizer, SaysWhereNothingMeetsWhatIsRequired) {
  const StudyFiles files;
  const Optimum optimum = optimumOf(readStudy(files.study(R"(
vary: {rotor.damping: {uniform: [1.0, 50.0]}}
run: {analyze: true, speed: 0.0}
measure: {decay: margins.decay_rate}
require: {decay: "> 1000"}
optimize: {maximize: decay}
)")));
  EXPECT_TRUE(optimum.values.empty());
  EXPECT_GT(optimum.evaluations, 1U);
}

TEST(Optimizer, EndsWhereItsEvaluationsDoAndWhereTheMeasureIsInfinite) {
  const StudyFiles files;
  const std::string rest = R"(
vary: {rotor.damping: {uniform: [1.0, 50.0]}}
run: {analyze: true, speed: 0.0}
)";
  const Optimum few = optimumOf(readStudy(files.study(
      rest +
      "measure: {decay: margins.decay_rate}\noptimize: {maximize: decay, evaluations: 5}\n")));
  EXPECT_EQ(few.evaluations, 5U);
  EXPECT_FALSE(few.converged);
  EXPECT_NE(few.ended.find("limit of 5 evaluations was reached"), std::string::npos) << few.ended;
  // Without rotating damping, a rotor never becomes unstable.
  const Optimum never = optimumOf(readStudy(files.study(
      rest +
      "measure: {threshold: margins.instability_speed}\noptimize: {maximize: threshold}\n")));
  EXPECT_EQ(never.evaluations, 1U);
  EXPECT_NE(never.ended.find("infinite"), std::string::npos) << never.ended;
}

}  // namespace optimizer_test
}  // namespace whirl_twin
