// `twin sweep` of a study that searches an optimum, as printed.
#include <gtest/gtest.h>

#include "swept_study.h"

namespace whirl_twin {
namespace study_optimum_test {

const std::string kStudy = R"(
study: {scene: scene.yaml}
vary: {rotor.damping: {uniform: [1.0, 150.0]}, rotor.stiffness: {uniform: [0.5e4, 2.0e4]}}
run: {analyze: true, speed: 0.0}
measure: {decay: margins.decay_rate, frequency: "natural_frequencies[0]"}
optimize: {maximize: decay, over: [rotor.damping], evaluations: 300}
)";

TEST(StudyOptimum, IsPrintedAsTextAndAsJson) {
  const StudyFiles files(kStudy);
  const Ending text = twin({"sweep", files.study});
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("maximum of decay over one parameter by cobyla"), std::string::npos);
  EXPECT_NE(text.out.find("at the largest of its range"), std::string::npos) << text.out;
  const Ending end = twin({"sweep", files.study, "--json"});
  const nlohmann::json said = end.json();
  EXPECT_EQ(said["maximize"], "decay");
  EXPECT_EQ(said["found"], true);
  EXPECT_EQ(said["converged"], true);
  EXPECT_NEAR(said["numbers"]["rotor.damping"]["best"].get<double>(), 150.0, 0.1);  // not yet 200
  EXPECT_EQ(said["numbers"]["rotor.damping"]["start"], 10.0);
  EXPECT_NEAR(said["measures"]["decay"]["best"].get<double>(), 75.0, 0.1);  // c / 2 m
  EXPECT_FALSE(said["numbers"].contains("rotor.stiffness"));
  EXPECT_LE(said["evaluations"], 300);
  EXPECT_EQ(twin({"sweep", files.study, "--json"}).out, end.out);
}

TEST(StudyOptimum, ThatThereIsNotIsExitStatusOne) {
  const StudyFiles files(kStudy + "require: {decay: \"> 100\"}\n");
  const Ending end = twin({"sweep", files.study, "--json"});
  EXPECT_EQ(end.status, 1) << end.err;
  EXPECT_EQ(end.json()["found"], false);
  EXPECT_NE(end.err.find("no point satisfies the requirements"), std::string::npos) << end.err;
  EXPECT_NE(twin({"sweep", files.study}).out.find("no point satisfies"), std::string::npos);
}

TEST(StudyOptimum, HasNoUseForWhatGoesWithADesign) {
  const StudyFiles files(kStudy);
  EXPECT_EQ(twin({"sweep", files.study, "--output", files.file("r")}).status, 2);
  EXPECT_EQ(twin({"sweep", files.study, "--point", "0"}).status, 2);
  EXPECT_EQ(twin({"plot", files.study, "--results", files.file("r")}).status, 2);
}

// The peak falls as the run-up gets faster: the smallest acceleration reaches the amplitude limit.
TEST(StudyOptimum, OfTheShippedRunUpIsAtItsLimit) {
  const nlohmann::json said =
      twin({"sweep", WHIRL_TWIN_SOURCE "/config/studies/slowest_run_up.yaml", "--json"}).json();
  EXPECT_NEAR(said["measures"]["peak"]["best"].get<double>(), 8.5e-4, 2.0e-6);
  EXPECT_NEAR(said["measures"]["acceleration"]["best"].get<double>(), 58.8, 0.2);
}

}  // namespace study_optimum_test
}  // namespace whirl_twin
