// The observer's evaluation of the twin's records: radius and unwrapped phase, the 1X orbit's axes,
// the shaft's angle, energies.
#include "twin/observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../scene/scenes.h"

namespace whirl_twin {
namespace observer_test {

constexpr double kSpeed = 30.0;  // [rad/s]

/// One rotor at a constant speed, in steps of a millisecond.
Scene rotorScene(const std::string& parameters = "", const std::string& initial = "") {
  return sceneOf(
      "{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 2, "
      "stiffness: 800, speed: 30" +
      parameters + "}, initial: {" + initial + "}}}}");
}

/// Synthetic records: the rotor has the position that the test sets.
class RotorRecords : public testing::Test {
 protected:
  RotorRecords() : twin_(rotorScene()), observer_(twin_), record_(twin_.layout().size) {
    twin_.write(record_.data());
  }

  void observe(std::int64_t step, double x, double y, double x_rate = 0.0, double y_rate = 0.0) {
    RecordLayout::setStep(record_.data(), step);
    RecordLayout::shaft(record_.data(), 0).setAngle(advance({}, kSpeed, step * 1000000));
    const SystemPlace system = twin_.layout().system(record_.data(), 0);
    system.q()[0] = x;
    system.q()[1] = y;
    system.v()[0] = x_rate;
    system.v()[1] = y_rate;
    observer_.observe(record_.data());
  }

  Twin twin_;
  Observer observer_;
  std::vector<double> record_;
};

TEST_F(RotorRecords, PhaseIsUnwrappedThroughSeveralTurns) {
  // The whirl lags by 2 rad/s more and more, as a free whirl slower than the shaft does.
  for (int step = 1; step <= 20000; ++step) {
    const double t = 1e-3 * step;
    const double whirl = (kSpeed - 2.0) * t - 0.5;
    observe(step, 1e-3 * std::cos(whirl), 1e-3 * std::sin(whirl));
    ASSERT_NEAR(observer_.whirl(0).phase, 0.5 + 2.0 * t, 1e-11) << t;
    ASSERT_TRUE(observer_.whirl(0).phase_valid);
  }
  EXPECT_GT(observer_.whirl(0).phase, 6.0 * 2.0 * M_PI);
  EXPECT_NEAR(observer_.whirl(0).radius, 1e-3, 1e-18);
  EXPECT_EQ(observer_.whirlPhase(0), observer_.whirl(0).phase);
}

// The 1X orbit divides by the speed: near standstill a leftover vibration would pass for a whirl.
TEST_F(RotorRecords, TheOrbitIsNotToldNearStandstill) {
  // rad/s; the natural frequency is 20
  RecordLayout::shaft(record_.data(), 0).setMotion(0.1, 0.0, 0.0, 0.1);
  observe(1, 1e-9, 0.0, 0.0, 1e-6);
  EXPECT_TRUE(std::isnan(observer_.whirl(0).orbit_major));
  EXPECT_TRUE(std::isnan(observer_.whirl(0).orbit_minor));
}

TEST_F(RotorRecords, PhaseRunsBackToo) {
  for (int step = 1; step <= 20000; ++step) {
    const double t = 1e-3 * step;
    const double whirl = (kSpeed + 2.0) * t;
    observe(step, 1e-3 * std::cos(whirl), 1e-3 * std::sin(whirl));
    ASSERT_NEAR(observer_.whirl(0).phase, -2.0 * t, 1e-11) << t;
  }
}

TEST_F(RotorRecords, PhaseIsUndefinedAtTheCentreAndGoesOnAfterwards) {
  observe(0, 0.0, 0.0);
  state::WhirlState whirl = observer_.whirl(0);
  EXPECT_FALSE(whirl.phase_valid);
  EXPECT_TRUE(std::isnan(whirl.phase));
  EXPECT_TRUE(std::isnan(whirl.whirl_angle));
  EXPECT_TRUE(std::isnan(whirl.whirl_rate));
  EXPECT_TRUE(std::isnan(observer_.whirlPhase(0)));
  EXPECT_EQ(whirl.radius, 0.0);
  for (int step = 1; step <= 1000; ++step) {
    const double whirled = (kSpeed - 20.0) * 1e-3 * step;
    observe(step, 1e-3 * std::cos(whirled), 1e-3 * std::sin(whirled));
  }
  EXPECT_NEAR(observer_.whirl(0).phase, 20.0, 1e-12);
  // Through the centre: a billionth of the largest radius has no angle.
  observe(1001, 1e-13, 0.0);
  EXPECT_FALSE(observer_.whirl(0).phase_valid);
  EXPECT_TRUE(std::isnan(observer_.whirl(0).phase));
  const double whirled = (kSpeed - 20.0) * 1.002;
  observe(1002, 1e-3 * std::cos(whirled), 1e-3 * std::sin(whirled));
  EXPECT_NEAR(observer_.whirl(0).phase, 20.04, 1e-12) << "the turns counted are kept";
}

TEST_F(RotorRecords, OrbitAxesAreForwardPlusAndLessBackward) {
  struct Mixture {
    double forward, backward;
  };
  for (const auto& [forward, backward] :
       {Mixture{3e-3, 1e-3}, Mixture{1e-3, 3e-3}, Mixture{2e-3, 0.0}, Mixture{0.0, 2e-3},
        Mixture{2e-3, 2e-3}}) {
    for (int step = 1; step < 400; step += 7) {
      const double a = kSpeed * 1e-3 * step + 0.3;
      const double b = kSpeed * 1e-3 * step - 1.1;
      observe(step, forward * std::cos(a) + backward * std::cos(b),
              forward * std::sin(a) - backward * std::sin(b),
              kSpeed * (-forward * std::sin(a) - backward * std::sin(b)),
              kSpeed * (forward * std::cos(a) - backward * std::cos(b)));
      const state::WhirlState whirl = observer_.whirl(0);
      ASSERT_NEAR(whirl.orbit_major, forward + backward, 1e-17);
      ASSERT_NEAR(whirl.orbit_minor, std::abs(forward - backward), 1e-17);
      if (forward != backward) {
        ASSERT_EQ(whirl.forward, forward > backward);
      }
    }
  }
}

TEST_F(RotorRecords, WhirlRateIsThatOfTheRadius) {
  observe(1, 3e-3, 4e-3, -4e-3 * 7.0 + 3e-3, 3e-3 * 7.0 + 4e-3);  // turns at 7 rad/s and grows
  EXPECT_NEAR(observer_.whirl(0).whirl_rate, 7.0, 1e-13);
  EXPECT_NEAR(observer_.whirl(0).whirl_angle, std::atan2(4.0, 3.0), 1e-15);
}

TEST_F(RotorRecords, AStepCountThatGoesBackStartsAfresh) {
  for (int step = 1; step <= 1000; ++step) {
    const double whirl = (kSpeed - 20.0) * 1e-3 * step;
    observe(step, 1e-3 * std::cos(whirl), 1e-3 * std::sin(whirl));
  }
  EXPECT_NEAR(observer_.whirl(0).phase, 20.0, 1e-12);
  observe(0, 1e-3 * std::cos(0.4), -1e-3 * std::sin(0.4));
  EXPECT_NEAR(observer_.whirl(0).phase, 0.4, 1e-15) << "no turns of the run before";
  EXPECT_EQ(observer_.whirl(0).energy_residual, 0.0);
}

void run(Twin& twin, Observer& observer, int steps) {
  std::vector<double> record(twin.layout().size);
  for (int i = 0; i < steps; ++i) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
  }
}

TEST(Observer, SeesTheSteadyWhirlOfAnUnbalancedRotor) {
  Twin twin(
      rotorScene(", damping: 40, eccentricity: 1.0e-3, eccentricity_angle: 0.7, phase_mark: 0.7"));
  Observer observer(twin);
  run(twin, observer, 4000);
  // p = 20 rad/s, zeta = 0.5, w/p = 1.5.
  const state::WhirlState whirl = observer.whirl(0);
  EXPECT_EQ(whirl.system, "rotor");
  EXPECT_EQ(whirl.at.step, 4000);
  EXPECT_EQ(whirl.at.time, 4.0);
  EXPECT_NEAR(whirl.radius, 1e-3 * 2.25 / std::hypot(1.25, 1.5), 1e-14);
  EXPECT_NEAR(whirl.phase, std::atan2(1.5, -1.25), 1e-11) << "behind the unbalance, not the mark";
  EXPECT_NEAR(whirl.whirl_rate, kSpeed, 1e-9);
  EXPECT_NEAR(whirl.orbit_major, whirl.radius, 1e-14);
  EXPECT_NEAR(whirl.orbit_minor, whirl.radius, 1e-14) << "a circle";
  EXPECT_TRUE(whirl.forward);
  EXPECT_EQ(whirl.speed, kSpeed);
  EXPECT_NEAR(whirl.shaft_angle, 120.0, 1e-12);
}

TEST(Observer, SeesPendulumsAndDrives) {
  Twin twin(sceneOf(kThreeSystems));
  Observer observer(twin);
  observer.setStamp(77);
  EXPECT_TRUE(observer.isRotor(0));
  EXPECT_FALSE(observer.isRotor(1));
  EXPECT_FALSE(observer.isRotor(2));
  state::PendulumState arms = observer.pendulum(2);
  EXPECT_EQ(arms.name, (std::vector<std::string>{"theta1", "theta2"}));
  EXPECT_EQ(arms.angle, (std::vector<double>{1.0, -0.5}));
  EXPECT_EQ(arms.rate, (std::vector<double>{0.0, 2.0}));
  EXPECT_NEAR(arms.kinetic, 0.5 * 2.0 * 0.25 * 4.0, 1e-15);
  EXPECT_NEAR(arms.potential,
              9.80665 * (3.0 * (1.0 - std::cos(1.0)) + 2.0 * 0.5 * (1.0 - std::cos(0.5))), 1e-14);
  EXPECT_EQ(arms.at.stamp, 77);
  run(twin, observer, 400);
  const state::DriveState shaft = observer.drive(0);
  EXPECT_EQ(shaft.drive, "shaft");
  EXPECT_EQ(shaft.target_speed, 12.0);
  EXPECT_EQ(shaft.speed, twin.drive(0).at(0.0).speed);
  EXPECT_EQ(shaft.shaft_angle, twin.drive(0).angle().total());
  EXPECT_NEAR(shaft.shaft_angle, 2.0 * M_PI * static_cast<double>(shaft.turns) + shaft.remainder,
              1e-14);
}

TEST(Observer, StationsOfAShaftHaveWhirlsOfTheirOwn) {
  const char* const shaft =
      "{step: 0.001, systems: {rotor: {model: flexible_rotor, parameters: {youngs_modulus: "
      "2.1e+11, "
      "density: 7800, speed: 50, modes: 0, elements: [{length: 0.1, outer_diameter: 0.05, count: "
      "4}], "
      "bearings: [{node: 0, kxx: 1.0e+7, kyy: 1.0e+7, cxx: 100, cyy: 100}, {node: 4, kxx: 1.0e+7, "
      "kyy: 1.0e+7, cxx: 100, cyy: 100}], unbalances: [{node: 2, magnitude: 1.0e-3, angle: 0.7}], "
      "stations: [{node: 1}, {node: 3}], phase_mark: 0.7}}}}";
  Twin twin(sceneOf(shaft));
  Observer observer(twin);
  run(twin, observer, 3000);
  EXPECT_EQ(observer.stations(0),
            (std::vector<std::string>{"rotor", "rotor_node_1", "rotor_node_3"}));
  const state::WhirlState middle = observer.whirl(0);
  const state::WhirlState left = observer.whirl(0, 1);
  const state::WhirlState right = observer.whirl(0, 2);
  EXPECT_EQ(left.system, "rotor_node_1");
  // All coordinates are kept: those of node i start at index 4 i, x first.
  EXPECT_EQ(left.x, observer.coordinates(0)[4]);
  EXPECT_EQ(left.y, observer.coordinates(0)[5]);
  EXPECT_EQ(right.x, observer.coordinates(0)[12]);
  EXPECT_EQ(middle.x, observer.coordinates(0)[8]);
  // Symmetric, below its first critical speed: the shaft whirls in phase with the unbalance.
  EXPECT_NEAR(left.radius, right.radius, 1e-9 * middle.radius);
  EXPECT_NEAR(left.phase, middle.phase, 1e-2);
  EXPECT_NEAR(middle.phase, 0.0, 1e-2);
  EXPECT_GT(middle.radius, left.radius);
}

}  // namespace observer_test
}  // namespace whirl_twin
