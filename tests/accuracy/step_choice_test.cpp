// The choice of `auto` meets the tolerance on every shipped scene; it is reproducible; and a
// tolerance that cannot be met is reported.
#include "accuracy/step_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "independent_motion.h"
#include "integration/step_methods.h"
#include "scene/scene_reader.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace step_choice_test {

struct Bounded {
  std::string scene;
  std::size_t system;
  double tolerance;
};

void PrintTo(const Bounded& p, std::ostream* out) {
  *out << p.scene << ", system " << p.system << ", " << p.tolerance;
}

std::vector<Bounded> everyPromise() {
  std::vector<Bounded> promises;
  for (const auto& file :
       std::filesystem::directory_iterator(std::string(WHIRL_TWIN_SOURCE) + "/config/scenes")) {
    const Scene scene = readSceneFile(file.path());
    if (!scene.controllers.empty()) {
      continue;  // not covered by the independent motion
    }
    for (std::size_t i = 0; i < scene.systems.size(); ++i) {
      // Above this the independent motion takes many minutes; smaller rotors of the same model are
      // checked.
      constexpr std::size_t kMaxCoordinates = 30;
      if (scene.systems[i].q.size() > kMaxCoordinates) {
        continue;
      }
      for (const double tolerance : {1.0e-3, 1.0e-6, 1.0e-9}) {
        promises.push_back({file.path().stem(), i, tolerance});
      }
    }
  }
  return promises;
}

class StepChoicePromise : public testing::TestWithParam<Bounded> {};

TEST_P(StepChoicePromise, IsKept) {
  const Bounded& promise = GetParam();
  const Scene scene =
      readSceneFile(std::string(WHIRL_TWIN_SOURCE) + "/config/scenes/" + promise.scene + ".yaml");
  Scene one = sceneOfOne(scene, promise.system);
  SystemSpec& spec = one.systems.front();
  spec.tolerance = promise.tolerance;
  spec.horizon = 2.0;  // s, for the test's own sake
  const StepChoice choice = chooseStep(one);
  const ErrorBound& p = choice.promise;
  // Many rotors with rubbing, hysteretic creep or stator impacts cannot be predicted for long:
  // there the choice states its horizon, and is tested up to it.
  const std::int64_t interval = std::max<std::int64_t>(1, 20'000'000 / one.step) * one.step;
  const auto samples = 1 + static_cast<std::size_t>(1.0e9 * p.known_until / interval + 1.0e-6);
  const auto kept = static_cast<std::size_t>(1.0e9 * p.kept_until / interval + 1.0e-6);
  const IndependentMotion truth = independentMotion(one, interval, samples, 1.0e6);
  const ErrorCurve error(
      motion(withSetting(one, {choice.integrator, one.step, choice.substeps}), interval, samples),
      truth.trajectory);
  std::size_t judged = truth.own.samples() - 1;  // as far as the reference is accurate
  while (judged > 0 &&
         truth.own.position(judged) > 0.1 * std::max(promise.tolerance, error.position(judged))) {
    --judged;
  }
  // A stiff rotor from rest: this reference is accurate only at the start, where the motion is
  // still small relative to the scale of the errors. There its own error is added to the tolerance.
  double unsure = 0.0;
  const std::size_t last = truth.own.samples() - 1;
  if (judged < last / 20 && truth.own.position(last) < promise.tolerance) {
    judged = last;
    unsure = 5.0 * truth.own.position(last);
  }
  EXPECT_LE(error.position(std::min(judged, kept)), promise.tolerance + unsure) << choice.reason;
  const std::size_t known = std::min(judged, samples - 1);
  EXPECT_LE(error.position(known), 5.0 * (p.error + truth.own.position(known)) + 1.0e-12)
      << choice.reason;
}

INSTANTIATE_TEST_SUITE_P(ShippedScenes, StepChoicePromise, testing::ValuesIn(everyPromise()),
                         [](const auto& test) {
                           const Bounded& p = test.param;
                           return p.scene + "_" + std::to_string(p.system) + "_1e" +
                                  std::to_string(static_cast<int>(-std::log10(p.tolerance)));
                         });

constexpr const char* kSwing = R"(
step: 0.001
systems:
  swing: {model: double_pendulum, tolerance: TOLERANCE, horizon: HORIZON,
    parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}, initial: {theta1: ANGLE, theta2: ANGLE}}
)";

Scene swing(const std::string& tolerance, const std::string& angle, const std::string& horizon) {
  std::string text = kSwing;
  for (const auto& [word, value] :
       {std::pair<std::string, std::string>{"TOLERANCE", tolerance}, {"HORIZON", horizon}}) {
    text.replace(text.find(word), word.size(), value);
  }
  while (text.find("ANGLE") != std::string::npos) {
    text.replace(text.find("ANGLE"), 5, angle);
  }
  return sceneOf(text);
}

TEST(StepChoice, CostsMoreWhereMoreIsAsked) {
  const StepChoice rough = chooseStep(swing("1.0e-2", "1.0", "5.0"));
  const StepChoice fine = chooseStep(swing("1.0e-10", "1.0", "5.0"));
  EXPECT_NE(rough.integrator, fine.integrator);
  EXPECT_LT(fine.promise.error, 1.0e-10);
  EXPECT_GT(rough.promise.error, fine.promise.error);
}

TEST(StepChoice, IsTheSameEveryTime) {
  const StepChoice first = chooseStep(swing("1.0e-6", "1.0", "5.0"));
  for (int i = 0; i < 3; ++i) {
    const StepChoice again = chooseStep(swing("1.0e-6", "1.0", "5.0"));
    EXPECT_EQ(again.integrator, first.integrator);
    EXPECT_EQ(again.substeps, first.substeps);
    EXPECT_EQ(again.reason, first.reason);
  }
}

TEST(StepChoice, SaysHowFarAChaoticMotionCanBePromised) {
  // Thrown from above the pivot, two rods tumble; their errors grow e-fold some ten times a second.
  const StepChoice choice = chooseStep(swing("1.0e-9", "3.0", "15.0"));
  EXPECT_LT(choice.promise.kept_until, 15.0);
  EXPECT_GT(choice.promise.kept_until, 1.0);
  EXPECT_NE(choice.reason.find("until t = "), std::string::npos) << choice.reason;
}

TEST(StepChoice, TakesNoMethodThatPredictsRatesWhereRatesEnterTheForces) {
  const Scene scene = sceneOf(R"(
step: 0.001
systems:
  rotor: {model: jeffcott_rotor, tolerance: 0.1, parameters: {mass: 1, stiffness: 1.0e4,
    damping: 10, internal_damping: 5, loss_factor: 0.01, speed: 50, eccentricity: 1.0e-4}}
)");
  const StepChoice choice = chooseStep(scene);
  EXPECT_NE(choice.integrator, "velocity_verlet");
  EXPECT_NE(choice.integrator, "semi_implicit_euler");
}

// The cart starts at 0: the effect of a small disturbance must not be scaled by zero.
TEST(StepChoice, PromisesAMotionOfWhatBeginsAtRest) {
  for (const char* start : {"initial: {theta: 0.2}", "inputs: {force: 3.0}",
                            "inputs: {force: {times: [0, 1], values: [0, 3], hold: true}}"}) {
    const StepChoice choice = chooseStep(sceneOf(
        std::string("{step: 0.001, systems: {crane: {model: cart_pendulum, parameters: {cart_mass: "
                    "20, rod_mass: 10, rod_length: 6, stiffness: 0}, ") +
        start + "}}}"));
    EXPECT_TRUE(choice.promise.kept) << start << ": " << choice.reason;
    EXPECT_LT(choice.promise.reference_error, 1e-12) << start;
  }
}

bool hasPast(const StepChoice& choice) {
  return stepMethod(choice.integrator).past > 0;
}

// A multistep method at a millisecond, thousands of steps and a hundredth of its limit.
TEST(StepChoice, TakesAMethodWithAPastWhereItIsProven) {
  const StepChoice choice = chooseStep(swing("1.0e-6", "0.3", "3.0"));
  EXPECT_TRUE(hasPast(choice)) << choice.reason;
  EXPECT_TRUE(choice.promise.kept) << choice.reason;
}

// By as many of the twin's steps as are proven, and as good in each of them.
TEST(StepChoice, StepsAheadWhereNothingActsFromOutside) {
  for (const char* tolerance : {"1.0e-3", "1.0e-6", "1.0e-9"}) {
    const Scene scene = swing(tolerance, "0.3", "10.0");
    const StepChoice choice = chooseStep(scene);
    EXPECT_EQ(choice.integrator, "stoermer_ahead") << choice.reason;
    EXPECT_GE(choice.substeps, 4) << choice.reason;
    EXPECT_TRUE(choice.promise.kept) << choice.reason;
    const IndependentMotion truth = independentMotion(scene, 7 * scene.step, 1400, 1.0e6);
    const ErrorCurve error(
        motion(withSetting(scene, {choice.integrator, scene.step, choice.substeps}), 7 * scene.step,
               1400),
        truth.trajectory);
    EXPECT_LE(error.position(1399), scene.systems.front().tolerance) << choice.reason;
  }
}

TEST(StepChoice, TakesNoMethodWithAPastThatHasNotShownMoreThanItsStart) {
  EXPECT_FALSE(hasPast(chooseStep(swing("1.0e-6", "0.3", "0.1"))));
}

// A pendulum departs slowly from its upright position, for longer than the trial run, and falls.
TEST(StepChoice, TakesNoMethodWithAPastForAMotionThatIsYetToQuicken) {
  const StepChoice choice = chooseStep(sceneOf(R"(
gravity: 1.0
step: 0.05
systems:
  falls: {model: spinning_pendulum, tolerance: 1.0e-8, horizon: 13,
    parameters: {mass: 1, length: 1, speed: 0}, initial: {theta: 3.14159255}}
)"));
  EXPECT_FALSE(hasPast(choice)) << choice.integrator << ": " << choice.reason;
}

// p h = 0.1; at a damping ratio of a half stoermer_6 is stable up to 0.05, stoermer up to 0.16.
TEST(StepChoice, TakesNoMethodWithAPastWhereItsLimitIsNear) {
  for (const double damping : {0.0, 10.0}) {
    Scene scene = sceneOf(R"(
step: 0.01
systems:
  swing: {model: spinning_pendulum, parameters: {mass: 1, length: 1, speed: 0}, initial: {theta: 0.5}}
)");
    scene.gravity = 100.0;
    scene.systems.front().parameters["damping"] = damping;
    scene.systems.front().tolerance = 1.0e-3;
    const StepChoice choice = chooseStep(scene);
    EXPECT_EQ(hasPast(choice), damping == 0.0) << choice.integrator << ": " << choice.reason;
  }
}

// A command may change a held input as often as once a step.
TEST(StepChoice, TakesNoMethodWithAPastUnderInputs) {
  Scene scene = swing("1.0e-6", "0.3", "10.0");
  scene.systems.front().inputs["torque1"] = InputSignal::constant(0.1);
  EXPECT_FALSE(hasPast(chooseStep(scene)));
}

TEST(StepChoice, IsWhatTheTwinStepsWith) {
  const Scene scene = withStepsChosen(sceneOf(R"(
step: 0.001
systems:
  exact: {model: jeffcott_rotor, parameters: {mass: 1, stiffness: 1.0e4, speed: 50}}
  swing: {model: spinning_pendulum, tolerance: 1.0e-4,
    parameters: {mass: 1, length: 1, speed: 1}, initial: {theta: 1}}
  named: {model: spinning_pendulum, integrator: gauss_legendre_4, substeps: 3,
    parameters: {mass: 1, length: 1, speed: 1}, initial: {theta: 1}}
)"));
  const Twin twin(scene);
  EXPECT_EQ(twin.systems()[0]->integrator, "exponential");
  EXPECT_EQ(twin.systems()[1]->integrator, scene.systems[1].chosen_integrator);
  EXPECT_NE(twin.systems()[1]->integrator_reason.find("over 10 s, tolerance 0.0001"),
            std::string::npos)
      << twin.systems()[1]->integrator_reason;
  EXPECT_EQ(twin.systems()[2]->integrator, "gauss_legendre_4");
  EXPECT_EQ(twin.systems()[2]->spec.substeps, 3);
  EXPECT_EQ(twin.systems()[2]->integrator_reason, "");
}

}  // namespace step_choice_test
}  // namespace whirl_twin
