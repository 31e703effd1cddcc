// State estimation of a rotor on a motor, by its probes and its keyphasor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "estimation/estimator_scene.h"
#include "followed_machine.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace followed_motor_test {

using testing::HasSubstr;

/// Hangs below its critical speed of 200 rad/s for a second, where the whirl takes all the torque,
/// then more is given, and it passes.
const std::string kMotor = R"(
name: rig
step: 0.0005
drives:
  shaft: {speed: 150.0, motor: {stall_torque: 0.9, no_load_speed: 400.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 5.0, stiffness: 2.0e5, damping: 40.0, eccentricity: 2.0e-4, polar_inertia: 0.02}
    inputs: {torque: {amplitude: 0.1, frequency: 10.0}}
sensors:
  probes:
    rate: 2000.0
    channels:
      x: {measures: rotor.x, noise: 3.0e-6}
      y: {measures: rotor.y, noise: 3.0e-6}
)";
const std::string kTacho = "  tacho: {keyphasor: shaft, jitter: 1.0e-6}\n";

TEST(FollowedMotor, IsFollowedByItsKeyphasor) {
  FollowSettings settings;
  settings.systems["rotor"].disturbance = 2.0e-3;
  settings.systems["rotor"].parameters = {{"stiffness", {0.03, 0.0}}, {"damping", {0.3, 0.0}}};
  std::string model = kMotor + kTacho;
  model.replace(model.find("2.0e5"), 5, "2.04e5");
  model.replace(model.find("40.0"), 4, "50.0");
  Twinned twin(model, settings);
  Machine machine(kMotor + kTacho);
  double fastest = 0.0;
  for (int k = 0; k < 20'000; ++k) {
    for (const state::Measurement& m : machine.step()) {
      twin.follower.take(m);
    }
    fastest = std::max(fastest, twin.speed);
  }
  EXPECT_GT(fastest, 300.0) << "it has passed";
  ASSERT_FALSE(twin.published.empty());
  const state::FollowState& published = twin.last();
  EXPECT_EQ(twin.follower.restarts(), 0);
  EXPECT_LT(published.refused, published.used / 100);
  EXPECT_NEAR(published.value[0], 2.0e5, 0.005 * 2.0e5);
  EXPECT_NEAR(published.value[1], 40.0, 0.2 * 40.0);
  EXPECT_LT(published.mismatch, published.mismatch_limit);
}

/// Held at its critical speed, a whirl of 4 mm is expected to be seen as far off as the shaft's
/// angle may be. That it is not as far off is no sign of a sensor that is stuck.
TEST(FollowedMotor, CapturedByItsCriticalSpeedHasTheNoiseOfItsProbes) {
  std::string scene = kMotor + "  tacho: {keyphasor: shaft, jitter: 5.0e-6}\n";
  scene.replace(scene.find("stall_torque: 0.9"), 17, "stall_torque: 0.3");
  scene.replace(scene.find("speed: 150.0"), 12, "speed: 190.0");
  scene.replace(scene.find("    inputs:"), scene.find("sensors:") - scene.find("    inputs:"), "");
  FollowSettings settings;
  settings.systems["rotor"].disturbance = 2.0e-3;
  Twinned twin(scene, settings);
  Machine machine(scene);
  double widest = 0.0;
  for (int k = 0; k < 12'000; ++k) {
    for (const state::Measurement& m : machine.step()) {
      twin.follower.take(m);
    }
    widest = std::max(widest, std::hypot(machine.x(), machine.y()));
  }
  EXPECT_GT(widest, 3.0e-3) << "captured";
  ASSERT_FALSE(twin.published.empty());
  EXPECT_GT(twin.last().mismatch, twin.last().mismatch_least);
  EXPECT_LT(twin.last().mismatch, twin.last().mismatch_limit);
}

TEST(FollowedMotor, OfWhichNothingTellsTheAngleIsRefused) {
  try {
    const Twinned twin(kMotor, {});
    FAIL() << "followed";
  } catch (const InputError& inputError) {
    EXPECT_THAT(inputError.what(),
                HasSubstr("systems.rotor: the torque of its motor is not measured"));
    EXPECT_THAT(inputError.what(), HasSubstr("keyphasor"));
  }
}

TEST(FollowedMotor, WhoseSpinIsMeasuredByAnotherSensorIsRefused) {
  std::string scene = kMotor + kTacho;
  scene.replace(scene.find("rotor.y"), 7, "rotor.spin");
  try {
    readEstimatorScene(YAML::Load(scene), "a test");
    FAIL() << "read";
  } catch (const InputError& inputError) {
    EXPECT_THAT(inputError.what(), HasSubstr("sensors.probes.y: must not measure the spin"));
  }
}

/// The controller is part of the plant, and only the keyphasor is measured.
TEST(FollowedMotor, LosesItsControllerAndNothingElse) {
  const std::string controlled = kMotor + kTacho + R"(
controllers:
  governor:
    type: speed
    rate: 1000.0
    measures: [rotor.spin_rate]
    acts_on: [rotor.torque]
    parameters: {speed: 300.0, max_acceleration: 15.0, max_jerk: 60.0, inertia: 0.02, kp: 0.5, ki: 1.0,
                 motor: [{speed: 0.0, torque: 0.6}]}
)";
  const Scene followed = readEstimatorScene(YAML::Load(controlled), "a test");
  EXPECT_TRUE(followed.controllers.empty());
  EXPECT_FALSE(followed.drives[0].motor.has_value());
  EXPECT_EQ(followed.drives[0].speed, 150.0);
  EXPECT_EQ(followed.systems[0].q.size(), 2u);
  EXPECT_TRUE(readEstimatorScene(YAML::Load(kMotor), "a test").drives[0].motor.has_value());
}

}  // namespace followed_motor_test
}  // namespace whirl_twin
