#include "studies/point_evaluator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "studies/answers.h"
#include "studies/study_reader.h"
#include "study_files.h"

namespace whirl_twin {
namespace point_evaluator_test {

const std::atomic<bool> kNever{false};

/// All points of a study.
StudyTable run(const Study& study) {
  const StepsChosen steps = chooseSteps(study);
  PointEvaluator evaluator(study, steps, kNever);
  StudyTable table;
  table.measures.resize(study.measures.size());
  for (std::uint64_t i = 0; i < study.points(); ++i) {
    const Outcome outcome = evaluator.at(study.valuesAt(i));
    table.failed.push_back(!outcome.failure.empty());
    table.failures += table.failed.back() ? 1 : 0;
    for (std::size_t k = 0; k < table.measures.size(); ++k) {
      table.measures[k].push_back(outcome.failure.empty() ? outcome.measures[k] : std::nan(""));
    }
  }
  return table;
}

// omega = sqrt(k / m) of k uniform within 10 %: its mean is p (1.1^1.5 - 0.9^1.5) / 0.3. Each of
// 2000 strata is met once: the error is that of a midpoint rule's.
TEST(Study, MeanFrequencyOfUniformStiffnessIsAsComputed) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {rotor.stiffness: {relative_half_width: 0.1}}
design: {latin_hypercube: 2000}
run: analyze
measure: {frequency: "natural_frequencies[0]"}
)"));
  const Distributed d = distributed(run(study).measures[0], std::vector<bool>(2000));
  EXPECT_NEAR(d.mean, 99.9582549, 2.0e-4);
}

// The peak of the steady response, e / (2 zeta sqrt(1 - zeta^2)), holds no k; damping c = 2 zeta
// sqrt(k m) does, so zeta is kept: the amplification factor at the critical speed stays.
TEST(Study, AmplificationHangsOnDampingRatioAlone) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {rotor.stiffness: {list: [0.25e4, 1.0e4, 4.0e4]}, rotor.damping: {list: [5, 10, 20]}}
design: list
run: analyze
measure: {factor: "critical_speeds[0].amplification_factor", critical: "critical_speeds[0]"}
)"));
  const StudyTable table = run(study);
  EXPECT_NEAR(table.measures[0][0], table.measures[0][1], 1e-6 * table.measures[0][1]);
  EXPECT_NEAR(table.measures[0][2], table.measures[0][1], 1e-6 * table.measures[0][1]);
  // Nc = p / sqrt(1 - 2 zeta^2)
  EXPECT_NEAR(table.measures[1][2], 200.0 / std::sqrt(1.0 - 2.0 * 0.0025), 1e-6);
}

TEST(Study, AResponseScalesWithItsEccentricity) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {rotor.eccentricity: {list: [1.0e-4, 2.0e-4]}}
design: grid
run: {duration: 3.0}
measure:
  peak: max(rotor.whirl.radius)
  ratio: max(rotor.whirl.radius) / rotor.eccentricity
  speed: final(shaft.speed)
  at: time_of_max(rotor.whirl.radius)
)"));
  const StudyTable table = run(study);
  ASSERT_EQ(table.failures, 0U);
  EXPECT_NEAR(table.measures[0][1], 2.0 * table.measures[0][0], 1e-12);
  EXPECT_NEAR(table.measures[1][0], table.measures[1][1], 1e-8);
  EXPECT_NEAR(table.measures[2][0], 200.0, 1e-9);
  EXPECT_GT(table.measures[3][0], 1.0);  // 100 rad/s is passed after a second
  EXPECT_LT(table.measures[3][0], 1.3);
}

// A disc that hangs 0.98 mm below its axis and whirls at 200 rad/s, in the end with e r^2 /
// sqrt((1 - r^2)^2 + (2 zeta r)^2), r = 2, zeta = 0.05: its radius holds the sag, its vibration
// does not, and is as large on the way as without gravity.
TEST(Study, VibrationIsTheAmplitudeOverARevolutionWithoutSag) {
  const StudyFiles files;
  const std::string study = R"(
vary: {rotor.eccentricity: {list: [1.0e-4]}}
design: grid
run: {duration: 8.0}
measure:
  vibration: final(rotor.whirl.vibration)
  settled: min(rotor.whirl.vibration)
  highest: max(rotor.whirl.vibration)
  radius: final(rotor.whirl.radius)
)";
  const StudyTable weightless = run(readStudy(files.study(study)));
  std::string scene = files.contents("scene.yaml");
  scene.insert(scene.find("eccentricity"), "gravity_on_shaft: true, ");
  files.write("scene.yaml", "gravity: 9.81\n" + scene);
  const StudyTable hanging = run(readStudy(files.study(study)));
  ASSERT_EQ(hanging.failures, 0U);
  const double steady = 1.0e-4 * 4.0 / std::hypot(3.0, 0.2);
  EXPECT_NEAR(hanging.measures[0][0], steady, 5e-3 * steady);  // of some 32 samples a turn
  EXPECT_NEAR(weightless.measures[3][0], steady, 1e-6 * steady);
  EXPECT_NEAR(hanging.measures[2][0], weightless.measures[2][0], 1e-9 * weightless.measures[2][0]);
  EXPECT_GT(hanging.measures[3][0], 0.8e-3);
  EXPECT_TRUE(std::isfinite(hanging.measures[1][0]));
}

TEST(Study, AllMovesTakeTheAccelerationTheirDriveIsGiven) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {shaft.max_acceleration: {list: [20, 50]}}
design: grid
run: {duration: 2.0}
measure: {speed: final(shaft.speed)}
)"));
  const StudyTable table = run(study);
  EXPECT_NEAR(table.measures[0][0], 40.0, 1e-9);
  EXPECT_NEAR(table.measures[0][1], 100.0, 1e-9);
}

TEST(Study, WhatFollowsAnotherNumberByDefaultStillDoes) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {rotor.stiffness: {list: [4.0e4]}}
design: grid
run: analyze
measure: {low: "natural_frequencies[0]", high: "natural_frequencies[1]"}
)"));
  const StudyTable table = run(study);
  EXPECT_NEAR(table.measures[0][0], 200.0, 1e-9);  // stiffness_y is stiffness
  EXPECT_NEAR(table.measures[1][0], 200.0, 1e-9);
}

TEST(Study, APointThatIsRefusedOrRunsAwayFailsAlone) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {rotor.mass: {normal: [1.0, 1.0e6]}, rotor.damping: {list: [10, 10, 10, 10]}}
design: {monte_carlo: 40}
run: analyze
measure: {frequency: "natural_frequencies[0]"}
)"));
  const StudyTable table = run(study);
  EXPECT_GT(table.failures, 10U);
  EXPECT_LT(table.failures, 30U);
  const StepsChosen steps = chooseSteps(study);
  PointEvaluator evaluator(study, steps, kNever);
  const std::string why = evaluator.at({-1.0, 10.0}).failure;
  EXPECT_NE(why.find("systems.rotor.parameters.mass: must be > 0 kg, found -1"), std::string::npos)
      << why;
  const Outcome good = evaluator.at({1.0, 10.0});
  EXPECT_EQ(good.failure, "");
  EXPECT_NEAR(good.measures[0], 100.0, 1e-9);
}

TEST(Study, ACriticalSpeedThatIsNotThereIsNoNumber) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary: {rotor.damping: {list: [10, 190]}}
design: grid
run: analyze
measure: {critical: "critical_speeds[0]"}
require: {critical: "> 0"}
)"));
  const Answers answers = answersOf(study, run(study));
  EXPECT_EQ(answers.failures, 0U);
  EXPECT_EQ(answers.measures[0].count, 1U);
  EXPECT_EQ(answers.measures[0].undefined, 1U);
  EXPECT_EQ(answers.yield->passed, 1U);
  EXPECT_EQ(answers.yield->of, 2U);
}

TEST(Study, AnchorsAreVariedApart) {
  const StudyFiles files;
  files.write("scene.yaml", R"(
step: 0.001
systems:
  one: {model: jeffcott_rotor, parameters: &p {mass: 1.0, stiffness: 1.0e4, speed: 10.0}}
  two: {model: jeffcott_rotor, parameters: *p}
)");
  const Study study = readStudy(files.study(R"(
vary: {one.mass: {list: [4.0]}}
design: grid
run: analyze
measure: {first: "one.natural_frequencies[0]", second: "two.natural_frequencies[0]"}
)"));
  const StudyTable table = run(study);
  EXPECT_NEAR(table.measures[0][0], 50.0, 1e-9);
  EXPECT_NEAR(table.measures[1][0], 100.0, 1e-9);
}

TEST(Study, AnInitialValueTheSceneLeavesOutIsSet) {
  const StudyFiles files;
  files.write("scene.yaml", R"(
step: 0.001
systems: {swing: {model: pendulum, parameters: {mass: 1.0, length: 1.0}}}
)");
  const Study study = readStudy(files.study(R"(
vary: {swing.initial.theta: {list: [0.1, 0.2]}, swing.initial.theta_rate: {list: [0.0, 0.5]}}
design: list
run: {duration: 0.1}
measure: {start: initial(swing.theta), rate: initial(swing.theta_rate)}
)"));
  const StudyTable table = run(study);
  EXPECT_EQ(table.measures[0], (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(table.measures[1], (std::vector<double>{0.0, 0.5}));
}

TEST(Study, ANumberOfCoordinatesThatChangesIsMeasuredWhereItIs) {
  const StudyFiles files;
  files.write("scene.yaml", R"(
step: 0.001
systems:
  beam:
    model: cantilever_beam
    parameters: {mass_per_length: 1.0, length: 1.0, bending_stiffness: 100.0, modes: 3}
    initial: {q3: 0.01}
)");
  const Study study = readStudy(files.study(R"(
vary: {systems.beam.parameters.modes: {list: [3, 4, 2]}}
design: grid
run: {duration: 0.01}
measure: {third: max(beam.q3)}
)"));
  const StudyTable table = run(study);
  EXPECT_EQ(table.failed, (std::vector<bool>{false, false, true}));
}

}  // namespace point_evaluator_test
}  // namespace whirl_twin
