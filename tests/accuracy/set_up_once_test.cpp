// The set-up of a model may be expensive: from the scene's text to the first step it is done once,
// with any number of readers, and once again for each change of its parameters.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "../twin/running_twin.h"
#include "accuracy/step_choice.h"
#include "models/model_registry.h"
#include "scene/built_scene.h"

namespace whirl_twin {
namespace set_up_once_test {

std::map<std::string, int> set_up;  // how often, by the model's name

/// A built-in model under another name, which counts.
ModelInfo counted(const std::string& model) {
  ModelInfo info = *findModel(model);
  info.name = "counted_" + model;
  info.setUp = [name = info.name, plain = info.setUp](const ParameterValues& values,
                                                      const Settings& settings,
                                                      const ModelContext& around) {
    ++set_up[name];
    return plain(values, settings, around);
  };
  return info;
}

class SetUpOnce : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    setModelSource(
        [] {
          return std::vector<ModelInfo>{counted("jeffcott_rotor"), counted("double_pendulum")};
        },
        [](const std::string& why) { FAIL() << why; });
  }
  void SetUp() override { set_up.clear(); }

  static int rotors() { return set_up["counted_jeffcott_rotor"]; }
  static int pendulums() { return set_up["counted_double_pendulum"]; }
};

// The pendulum's method is found by a calibration of dozens of runs.
constexpr const char* kCounted = R"(
step: 0.001
drives: {shaft: {speed: 5.0, profile: [{speed: 30.0, max_acceleration: 20.0}]}}
systems:
  rotor:
    model: counted_jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 1.0}
  arms:
    model: counted_double_pendulum
    parameters: {mass1: 1.0, mass2: 2.0, length1: 1.0, length2: 0.5}
    initial: {theta1: 1.0, theta2: -0.5, theta2_rate: 2.0}
)";

TEST_F(SetUpOnce, FromReadingTheSceneToTheFirstStep) {
  const Scene scene = withStepsChosen(sceneOf(kCounted));
  EXPECT_NE(scene.systems[1].choice_reason, "") << "it was calibrated";
  Twin twin(scene);
  twin.step();
  EXPECT_EQ(rotors(), 1);
  EXPECT_EQ(pendulums(), 1);
}

TEST_F(SetUpOnce, ForAllWhoAskWhatIsBuilt) {
  const Scene scene = sceneOf(kCounted);
  const BuiltScene one = build(scene);
  const BuiltScene other = build(scene);
  EXPECT_EQ(one.systems[0]->dynamics, other.systems[0]->dynamics) << "shared";
  EXPECT_EQ(rotors(), 1);
  EXPECT_EQ(pendulums(), 1);
}

TEST_F(SetUpOnce, ForEveryChangeThatIsAsked) {
  Running twin(sceneOf(kCounted));
  twin.cycle(10);
  for (int change = 1; change <= 3; ++change) {
    ASSERT_TRUE(twin.set("rotor", "damping", 10.0 + change).done);
    EXPECT_EQ(rotors(), 1 + change);
  }
  EXPECT_FALSE(twin.set("rotor", "mass", -1.0).done);
  EXPECT_EQ(rotors(), 4) << "what is out of range is not built";
  EXPECT_EQ(pendulums(), 1);
}

TEST_F(SetUpOnce, ForTheSystemOfAnEnsembleAndForEachMember) {
  Twin twin(sceneOf(R"(
step: 0.001
systems:
  rotor:
    model: counted_jeffcott_rotor
    parameters: {mass: 1.0, stiffness: 1.0e4, speed: 30.0}
    count: 5
    spread: {stiffness: {relative_half_width: 0.1}}
)"));
  twin.buildEnsembles();
  twin.step();
  EXPECT_EQ(rotors(), 1 + 5);
}

// A change after reading is included in the built system.
TEST_F(SetUpOnce, AndAnewWhereTheSpecWasChanged) {
  Scene scene = sceneOf(kCounted);
  scene.systems[0].integrator = "runge_kutta_4";
  scene.systems[0].q = {1.0e-3, 0.0};
  EXPECT_EQ(build(scene).systems[0]->integrator, "runge_kutta_4");
  EXPECT_EQ(rotors(), 1) << "no setup depends on those";
  scene.systems[0].parameters["mass"] = 2.0;
  const BuiltScene heavier = build(scene);
  EXPECT_EQ(rotors(), 2);
  EXPECT_EQ(heavier.systems[0]->dynamics->linearRotor().matrices(0.0).mass(0, 0), 2.0);
  static_cast<void>(Twin(heavier.scene));
  EXPECT_EQ(rotors(), 2) << "a built scene carries its new setup on";
  scene.gravity = 1.6;
  static_cast<void>(build(scene));
  EXPECT_EQ(pendulums(), 2);
}

}  // namespace set_up_once_test
}  // namespace whirl_twin
