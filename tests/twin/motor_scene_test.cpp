// A drive with a motor: its settings in a scene, errors, and the balance of its work.
#include <gtest/gtest.h>

#include <cmath>

#include "../scene/scenes.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace motor_scene_test {

std::string scene(const std::string& motor, const std::string& system = "") {
  return "{step: 0.0005, drives: {engine: {speed: 20.0, angle: 0.5, motor: " + motor +
         "}}, systems: {rotor: {model: jeffcott_rotor, drive: engine, parameters: {mass: 2, "
         "stiffness: 2.0e4, stiffness_y: 1.6e4, damping: 8, internal_damping: 3, fluid_damping: 5, "
         "fluid_ratio: 0.48, cross_coupling: 40, eccentricity: 2.0e-3, eccentricity_angle: 0.4, "
         "bow: 1.0e-3, bow_angle: -1, polar_inertia: 0.02, gravity_on_shaft: true" +
         system + "}}}}";
}

std::string diagnostics(const std::string& yaml) {
  try {
    sceneOf(yaml);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(MotorScene, TakesEachLawOfAMotor) {
  const Scene constant = sceneOf(scene("{torque: 0.3, drag: 0.01}"));
  EXPECT_EQ(constant.drives[0].motor->torque(77.0), 0.3);
  EXPECT_EQ(constant.drives[0].motor->drag, 0.01);
  const Scene falling = sceneOf(scene("{stall_torque: 0.8, no_load_speed: 400}"));
  EXPECT_DOUBLE_EQ(falling.drives[0].motor->torque(100.0), 0.6);
  const Scene table = sceneOf(
      scene("{table: [{speed: 0, torque: 1}, {speed: 100, torque: 2}, {speed: 150, torque: 0}]}"));
  EXPECT_DOUBLE_EQ(table.drives[0].motor->torque(50.0), 1.5);
  EXPECT_DOUBLE_EQ(table.drives[0].motor->torque(125.0), 1.0);
  EXPECT_DOUBLE_EQ(table.drives[0].motor->torque(999.0), 0.0);
}

TEST(MotorScene, StartsTheSpinAsTheDriveDoes) {
  const Scene s = sceneOf(scene("{torque: 0.3}"));
  EXPECT_EQ(s.systems[0].q.back(), 0.5);
  EXPECT_EQ(s.systems[0].v, (std::vector<double>{0.0, 0.0, 20.0}));
}

TEST(MotorScene, SaysAllThatIsWrongWithAMotor) {
  const std::string two = diagnostics(scene("{torque: 0.3, stall_torque: -1, drag: -2}"));
  for (const char* part :
       {"drives.engine.motor: must be one of {torque}, {stall_torque, no_load_speed} and {table}",
        "drives.engine.motor.stall_torque: must be > 0 N m, found -1",
        "drives.engine.motor.no_load_speed: missing; must be > 0 rad/s",
        "drives.engine.motor.drag: must be >= 0 N m s/rad, found -2"}) {
    EXPECT_NE(two.find(part), std::string::npos) << part << "\nis not in\n" << two;
  }
  EXPECT_NE(diagnostics(scene("{table: [{speed: 1, torque: 1}]}")).find("2 to 32"),
            std::string::npos);
  EXPECT_NE(
      diagnostics(scene("{table: [{speed: 9, torque: 1}, {speed: 1, torque: 2}]}"))
          .find("motor.table[1].speed: must be greater than the one before, 9 rad/s, found 1"),
      std::string::npos);
  EXPECT_NE(diagnostics(scene("{torque: 1}, profile: [{speed: 3, max_acceleration: 1}]"))
                .find("drives.engine.profile: a motor's speed is not prescribed"),
            std::string::npos);
  EXPECT_NE(diagnostics(scene("{torque: 1}", "}, initial: {spin_rate: 3"))
                .find("systems.rotor.initial.spin_rate: must not be given: the shaft starts with "
                      "the angle and speed of its drive"),
            std::string::npos);
}

TEST(MotorScene, NeedsAnInertiaAndOneSystemThatTakesAMotor) {
  std::string light = scene("{torque: 1}");
  light.replace(light.find("polar_inertia: 0.02, "), 21, "");
  EXPECT_NE(diagnostics(light).find(
                "systems.rotor.parameters.polar_inertia: must be > 0 kg m^2 with a motor"),
            std::string::npos);
  const std::string two = diagnostics(
      "{step: 0.001, drives: {m: {motor: {torque: 1}}}, systems: {a: {model: spinning_pendulum, "
      "drive: m, parameters: {mass: 1, length: 1}}, b: {model: jeffcott_rotor, drive: m, "
      "parameters: {mass: 1, stiffness: 1, polar_inertia: 1}}}}");
  EXPECT_NE(two.find("systems.a.drive: spinning_pendulum cannot be turned by a motor"),
            std::string::npos)
      << two;
  EXPECT_NE(two.find("drives.m.motor: a motor turns exactly one system, found 2"),
            std::string::npos)
      << two;
}

// Every effect at once. The audit's quadrature and the step are of order 6: at 0.05 rad of whirl a
// step the residual is 1e-10 of the energy in play.
TEST(MotorScene, ItsWorkIsWhatIsDissipatedAndGained) {
  Twin twin(sceneOf(scene("{stall_torque: 0.8, no_load_speed: 150, drag: 1.0e-4}")));
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  const state::MotorState start = observer.motor(0);
  double lost = 0.0;
  double before = start.dissipated_power + start.drag_power;
  double scale = 0.0;
  for (int i = 0; i < 6000; ++i) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
    const state::MotorState now = observer.motor(0);
    // The cross-coupled stiffness feeds the whirl: q (x y' - y x').
    const double fed = 40.0 * (observer.coordinates(0)[0] * observer.rates(0)[1] -
                               observer.coordinates(0)[1] * observer.rates(0)[0]);
    const double after = now.dissipated_power + now.drag_power - fed;
    lost += 0.5 * 0.0005 * (before + after);
    before = after;
    scale = std::max(scale, std::fabs(now.energy));
  }
  const state::MotorState end = observer.motor(0);
  EXPECT_GT(end.motor_work, 0.5);
  EXPECT_LT(std::fabs(observer.energyResidual(0)), 1e-9);
  EXPECT_NEAR(end.motor_work, end.dissipated_work + end.energy - start.energy, 1e-9 * scale);
  // Trapezoid of powers that swing at twice the speed: (h w)^2 / 6 of them.
  EXPECT_NEAR(end.dissipated_work, lost, 2e-3 * end.dissipated_work);
  EXPECT_EQ(end.system, "rotor");
  EXPECT_DOUBLE_EQ(end.torque, 0.8 * (1.0 - end.speed / 150.0));
}

TEST(MotorScene, AConstantTorqueHasDoneTorqueTimesAngle) {
  Twin twin(sceneOf(scene("{torque: 0.5}")));
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  for (int i = 0; i < 2000; ++i) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
  }
  const double turned = observer.drive(0).shaft_angle - 0.5;
  EXPECT_NEAR(observer.motor(0).motor_work, 0.5 * turned, 1e-8 * turned);
}

TEST(MotorScene, ItsShaftIsTheOneThatIsPublished) {
  Twin twin(sceneOf(scene("{torque: 0.5}")));
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  for (int i = 0; i < 500; ++i) {
    twin.step();
  }
  twin.write(record.data());
  observer.observe(record.data());
  const state::DriveState shaft = observer.drive(0);
  const state::WhirlState whirl = observer.whirl(0);
  EXPECT_EQ(shaft.speed, observer.rates(0)[2]);
  EXPECT_DOUBLE_EQ(shaft.shaft_angle, observer.coordinates(0)[2]);
  EXPECT_GE(shaft.remainder, 0.0);
  EXPECT_LT(shaft.remainder, 6.283185307179587);
  EXPECT_EQ(whirl.speed, shaft.speed);
  EXPECT_EQ(shaft.target_speed, shaft.speed);
  // Its acceleration is that of the next small change of speed.
  const double speed = shaft.speed;
  const double acceleration = shaft.acceleration;
  twin.step();
  twin.write(record.data());
  observer.observe(record.data());
  EXPECT_NEAR(0.5 * (acceleration + observer.drive(0).acceleration),
              (observer.drive(0).speed - speed) / 0.0005, 1e-2 * std::fabs(acceleration) + 1e-3);
  EXPECT_FALSE(twin.setSpeed(0, 30.0, 10.0, 10.0)) << "a motor's speed is not prescribed";
  twin.reset();
  twin.write(record.data());
  observer.observe(record.data());
  EXPECT_EQ(observer.drive(0).speed, 20.0);
  EXPECT_DOUBLE_EQ(observer.drive(0).shaft_angle, 0.5);
  EXPECT_EQ(observer.motor(0).motor_work, 0.0);
}

}  // namespace motor_scene_test
}  // namespace whirl_twin
