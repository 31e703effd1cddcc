#include "studies/block_evaluator.h"

#include <gtest/gtest.h>

#include "studies/study_reader.h"
#include "study_files.h"

namespace whirl_twin {
namespace block_evaluator_test {

const std::string kRunUp = R"(
vary:
  rotor.stiffness: {relative_half_width: 0.1}
  rotor.eccentricity: {normal: [1.0e-4, 2.0e-5]}
  rotor.initial.x: {uniform: [0.0, 1.0e-4]}
  rotor.damping: {normal: [10.0, 5.0]}
design: {latin_hypercube: 100}
run: {duration: 2.0}
measure: {peak: max(rotor.whirl.radius), ratio: max(rotor.whirl.radius) / rotor.eccentricity}
)";

// The exact step and that of rotors side by side are within 1e-9 of one another.
TEST(Block, RotorsSideBySidePeakAsTheyDoOneByOne) {
  const std::atomic<bool> never{false};
  const StudyFiles files;
  const std::string path = files.study(kRunUp);
  Study study = readStudy(path);
  study.block = 40;
  const StepsChosen steps = chooseSteps(study);
  BlockEvaluator blocks(study, steps, never);
  PointEvaluator one(study, steps, never);
  int failed = 0;
  for (std::uint64_t block = 0; block < study.blocks(); ++block) {
    std::uint64_t calls = 0;
    const std::vector<Outcome> outcomes = blocks.outcomes(block, [&](std::uint64_t) { ++calls; });
    EXPECT_EQ(calls, 1U);  // they went together
    ASSERT_EQ(outcomes.size(), study.sizeOf(block));
    for (std::uint64_t i = 0; i < outcomes.size(); ++i) {
      const std::uint64_t point = study.firstOf(block) + i;
      const Outcome alone = one.at(study.valuesAt(point));
      EXPECT_EQ(outcomes[i].failure, alone.failure);
      failed += alone.failure.empty() ? 0 : 1;
      for (std::size_t k = 0; k < alone.measures.size(); ++k) {
        EXPECT_NEAR(outcomes[i].measures[k], alone.measures[k], 1.0e-9 * alone.measures[k]);
      }
      if (i % 17 == 0) {
        EXPECT_EQ(blocks.at(point).measures, outcomes[i].measures);
      }
    }
  }
  EXPECT_GT(failed, 0);  // of negative damping
}

// Studies that vary the drive or a cross-coupling, or have another measure, are evaluated one by
// one.
TEST(Block, OthersGoOneByOne) {
  const std::atomic<bool> never{false};
  const StudyFiles files;
  for (const std::string& study_text :
       {std::string(kRunUp).replace(kRunUp.find("rotor.damping"), 13, "shaft.speed"),
        std::string(kRunUp).replace(kRunUp.find("max("), 3, "rms"),
        std::string(kRunUp).replace(kRunUp.find("rotor.damping"), 13, "rotor.cross_coupling")}) {
    Study study = readStudy(files.study(study_text));
    study.block = 5;
    const StepsChosen steps = chooseSteps(study);
    BlockEvaluator blocks(study, steps, never);
    std::uint64_t calls = 0;
    const std::vector<Outcome> outcomes = blocks.outcomes(0, [&](std::uint64_t) { ++calls; });
    EXPECT_EQ(calls, 5U);
    EXPECT_EQ(outcomes.size(), 5U);
  }
}

/// Of the first five points of the study; nothing: they went together.
std::vector<Outcome> oneByOne(const StudyFiles& files, const std::string& rest) {
  const std::atomic<bool> never{false};
  Study study = readStudy(files.study(rest));
  study.block = 5;
  const StepsChosen steps = chooseSteps(study);
  std::uint64_t calls = 0;
  std::vector<Outcome> outcomes =
      BlockEvaluator(study, steps, never).outcomes(0, [&](std::uint64_t) { ++calls; });
  return calls == 1 ? std::vector<Outcome>() : outcomes;
}

// A number that the scene gives stays where it is, though another follows by default.
TEST(Block, ANumberThatIsGivenDoesNotFollow) {
  const StudyFiles files;
  const std::string study = R"(
vary: {rotor.stiffness: {uniform: [0.9e4, 1.1e4]}}
design: {monte_carlo: 5}
run: {duration: 0.5}
measure: {peak: max(rotor.whirl.radius)}
)";
  EXPECT_TRUE(oneByOne(files, study).empty());
  const std::string given = "stiffness: 1.0e4, ";
  std::string scene = files.contents("scene.yaml");
  scene.insert(scene.find(given) + given.size(), "stiffness_y: 1.0e4, ");
  files.write("scene.yaml", scene);
  EXPECT_EQ(oneByOne(files, study).size(), 5U);
}

// The barred ranges about critical speeds differ between points.
TEST(Block, RotorsOnADriveThatAvoidsTheirCriticalSpeedsGoOneByOne) {
  const StudyFiles files;
  std::string scene = files.contents("scene.yaml");
  scene.insert(scene.find("    profile:"), "    avoid: {critical_speeds: true}\n");
  files.write("scene.yaml", scene);
  EXPECT_EQ(oneByOne(files, R"(
vary: {rotor.stiffness: {uniform: [0.9e4, 1.1e4]}}
design: {monte_carlo: 5}
run: {duration: 0.5}
measure: {peak: max(rotor.whirl.radius)}
)")
                .size(),
            5U);
}

}  // namespace block_evaluator_test
}  // namespace whirl_twin
