// A built system of a scene: changes by the paths of its parameters, with the error texts of a
// scene file, and access without any step.
#include "scene/built_system.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene/built_scene.h"
#include "scene/scene_error.h"
#include "scenes.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace built_system_test {

constexpr const char* kShaft = R"(
step: 0.001
systems:
  shaft:
    model: flexible_rotor
    parameters:
      youngs_modulus: 211.0e+9
      density: 7810.0
      elements: [{length: 0.25, outer_diameter: 0.05, count: 2}]
      bearings: [{node: 0, kxx: 1.0e+6, kyy: 1.0e+6}, {node: 2, kxx: 1.0e+6, kyy: 1.0e+6}]
      modes: 0
      speed: 10.0
  linear:
    model: linear_system
    parameters: {mass: [[1, 0], [0, 2]], stiffness: [[3, -1], [-1, 3]]}
)";

/// The error of a change; "" if it is accepted.
std::string inputErrorOf(const BuiltSystem& system, const std::string& path, double value) {
  try {
    static_cast<void>(system.with({path}, {value}, "set_parameter"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BuiltSystem, WithOtherNumbersIsAnotherOne) {
  const SharedSystem rotor = build(sceneOf(kThreeSystems)).systems[0];
  const SharedSystem heavier = rotor->with({"mass", "damping"}, {4.0, 7.0}, "test");
  EXPECT_EQ(heavier->parameter("mass"), 4.0);
  EXPECT_EQ(heavier->parameter("damping"), 7.0);
  EXPECT_EQ(heavier->dynamics->linearRotor().matrices(0.0).mass(0, 0), 4.0);
  EXPECT_EQ(heavier->drive, rotor->drive);
  EXPECT_EQ(heavier->integrator, rotor->integrator);
  EXPECT_EQ(rotor->parameter("mass"), 1.0) << "the first is what it was";
  EXPECT_EQ(rotor->dynamics->linearRotor().matrices(0.0).mass(0, 0), 1.0);
}

TEST(BuiltSystem, KnowsItsNumbersByTheirPaths) {
  const BuiltScene scene = build(sceneOf(kShaft));
  const BuiltSystem& shaft = *scene.systems[0];
  EXPECT_EQ(shaft.parameter("bearings[1].kxx"), 1.0e6);
  EXPECT_EQ(shaft.parameter("bearings[2].kxx"), std::nullopt);
  EXPECT_EQ(shaft.with({"bearings[1].kxx"}, {2.0e6}, "")->parameter("bearings[1].kxx"), 2.0e6);
  const BuiltSystem& linear = *scene.systems[1];
  EXPECT_EQ(linear.parameter("stiffness[0][1]"), -1.0);
  EXPECT_EQ(linear.with({"stiffness[1][1]"}, {5.0}, "")->parameter("stiffness[1][1]"), 5.0);
}

TEST(BuiltSystem, RefusesInTheWordsOfASceneFile) {
  const BuiltScene scene = build(sceneOf(kThreeSystems));
  const BuiltSystem& rotor = *scene.systems[0];
  EXPECT_EQ(inputErrorOf(rotor, "mass", -1.0),
            "set_parameter: systems.rotor.parameters.mass: must be > 0 kg, found -1");
  EXPECT_EQ(inputErrorOf(rotor, "mass", std::numeric_limits<double>::quiet_NaN()),
            "set_parameter: systems.rotor.parameters.mass: must be > 0 kg, found 'nan'");
  EXPECT_EQ(inputErrorOf(rotor, "eccentricity_angle", std::numeric_limits<double>::infinity()),
            "set_parameter: systems.rotor.parameters.eccentricity_angle: must be a finite number "
            "in rad, found 'inf'");
  EXPECT_EQ(inputErrorOf(rotor, "dampin", 1.0),
            "set_parameter: systems.rotor.parameters.dampin: unknown parameter of jeffcott_rotor; "
            "did you mean 'damping'?");
  EXPECT_EQ(inputErrorOf(rotor, "mass[0]", 1.0),
            "set_parameter: systems.rotor.parameters.mass[0]: is a single number: write the name "
            "without an index");
  const BuiltScene shafts = build(sceneOf(kShaft));
  EXPECT_EQ(
      inputErrorOf(*shafts.systems[0], "bearings[0].kx", 1.0),
      "set_parameter: systems.shaft.parameters.bearings[0].kx: unknown parameter of bearings; "
      "did you mean 'kxx'?");
  EXPECT_EQ(inputErrorOf(*shafts.systems[1], "mass[0][0]", -1.0)
                .find("set_parameter: systems.linear.parameters.mass: "),
            0u)
      << "each number is right, but they do not fit together";
}

TEST(BuiltSystem, TakesACompleteSetOfItsOwnOnly) {
  const BuiltScene scene = build(sceneOf(kThreeSystems));
  const BuiltSystem& rotor = *scene.systems[0];
  state::ParameterChange set = rotor.parameters();
  EXPECT_EQ(rotor.with(set)->dynamics, rotor.dynamics) << "told again";
  set.values[0] = 4.0;
  ASSERT_NE(rotor.with(set), nullptr);
  EXPECT_EQ(rotor.with(set)->parameter(set.names[0]), 4.0);
  set.values[0] = -4.0;
  EXPECT_EQ(rotor.with(set), nullptr);
  set = rotor.parameters();
  set.values.pop_back();
  EXPECT_EQ(rotor.with(set), nullptr);
  EXPECT_EQ(scene.systems[1]->with(rotor.parameters()), nullptr) << "of another system";
}

// Its cross-coupling makes the whirl grow so fast in a step of a second that no table over the
// speeds can follow it. That is a matter of the step only.
TEST(BuiltScene, IsThereWhereNoStepCanBePrepared) {
  const Scene scene = sceneOf(kUnsteppable);
  EXPECT_THROW(Twin{scene}, SceneError);
  const BuiltScene built = build(scene);
  EXPECT_EQ(built.systems[0]->integrator, "exponential");
  EXPECT_TRUE(built.systems[0]->dynamics->isRotor());
  EXPECT_EQ(built.driveOf(*built.systems[0]).speedRange().second, 3000.0);
}

TEST(BuiltScene, HasTheDrivesOfTheSceneThenThoseOfConstantSpeeds) {
  Scene scene = sceneOf(kThreeSystems);
  scene.systems[0].drive.reset();
  scene.systems[0].speed = 42.0;
  const BuiltScene built = build(scene);
  const std::vector<Drive> drives = built.drives();
  ASSERT_EQ(drives.size(), 3u);
  EXPECT_EQ(drives[0].at(0.0).speed, 5.0);
  EXPECT_EQ(built.systems[0]->drive, 1u);
  EXPECT_EQ(drives[1].at(0.0).speed, 42.0);
  EXPECT_EQ(built.systems[1]->drive, 0u);
  for (const SharedSystem& system : built.systems) {
    EXPECT_EQ(built.driveOf(*system).at(0.0).speed, drives[system->drive].at(0.0).speed);
  }
}

}  // namespace built_system_test
}  // namespace whirl_twin
