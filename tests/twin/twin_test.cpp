// The twin keeps exact time, is bit-reproducible, and lets one system fail without the others.
#include "twin/twin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <ostream>

#include "../scene/scenes.h"
#include "twin/stop_text.h"

namespace whirl_twin {
namespace twin_test {

std::vector<double> record(const Twin& twin) {
  std::vector<double> r(twin.layout().size, 0.0);
  twin.write(r.data());
  return r;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

void run(Twin& twin, int steps) {
  for (int i = 0; i < steps; ++i) {
    twin.step();
  }
}

double q(const Twin& twin, std::size_t system, std::size_t coordinate) {
  return twin.layout().system(record(twin).data(), system).q()[coordinate];
}

TEST(Twin, TimeIsStepsTimesStep) {
  for (const auto& [step, start] :
       {std::pair("0.001", "0"), std::pair("0.000123457", "-17.25"), std::pair("1e-9", "1e9")}) {
    Twin twin(sceneOf("{step: " + std::string(step) + ", time: " + start +
                      ", systems: {a: {model: jeffcott_rotor, parameters: {mass: 1, stiffness: 1, "
                      "speed: 1}}}}"));
    run(twin, 1000000);
    EXPECT_EQ(twin.stepCount(), 1000000);
    // From whole nanoseconds, rounded once: no sum of a million steps.
    const Scene& scene = twin.scene();
    EXPECT_EQ(twin.time(), static_cast<double>(scene.time + 1000000 * scene.step) / 1e9);
  }
}

TEST(Twin, TurnsItsShaftsByTheExactAngle) {
  Twin twin(sceneOf(
      "{step: 0.001, systems: {a: {model: jeffcott_rotor, parameters: {mass: 1, stiffness: 1e4, "
      "speed: 314.0}}}}"));
  run(twin, 1000000);
  const double total = twin.drive(0).angle().total();
  EXPECT_NEAR(total, 314.0 * 1000.0, 1e-10);
}

TEST(Twin, SameSceneGivesSameBits) {
  Twin one(sceneOf(kThreeSystems));
  Twin other(sceneOf(kThreeSystems));
  for (int i = 0; i < 3000; ++i) {
    one.step();
    other.step();
    ASSERT_TRUE(sameBits(record(one), record(other))) << "step " << i;
  }
}

TEST(Twin, ResetRestoresTheStartBitForBit) {
  Twin twin(sceneOf(kThreeSystems));
  const std::vector<double> start = record(twin);
  run(twin, 1234);
  const std::vector<double> later = record(twin);
  EXPECT_FALSE(sameBits(start, later));
  ASSERT_TRUE(twin.setSpeed(0, 40.0, 100.0, 1000.0));
  run(twin, 500);
  twin.reset();
  EXPECT_EQ(twin.stepCount(), 0);
  EXPECT_TRUE(sameBits(record(twin), start));
  // And what follows is the same too: nothing is remembered of the first run.
  run(twin, 1234);
  EXPECT_TRUE(sameBits(record(twin), later));
}

TEST(Twin, SystemsDoNotDependOnTheirNeighbours) {
  Twin three(sceneOf(kThreeSystems));
  Scene alone = sceneOf(kThreeSystems);
  alone.systems.erase(alone.systems.begin(), alone.systems.begin() + 2);
  Twin one(alone);
  run(three, 1000);
  run(one, 1000);
  EXPECT_EQ(q(three, 2, 0), q(one, 0, 0));
  EXPECT_EQ(q(three, 2, 1), q(one, 0, 1));
}

TEST(Twin, SubstepsAreSmallerSteps) {
  const std::string pendulum =
      ", systems: {a: {model: double_pendulum, integrator: runge_kutta_4, parameters: {mass1: 1, "
      "mass2: 1, length1: 1, length2: 1}, initial: {theta1: 1}, substeps: ";
  Twin fine(sceneOf("{step: 0.001" + pendulum + "1}}}"));
  Twin coarse(sceneOf("{step: 0.004" + pendulum + "4}}}"));
  run(fine, 4000);
  run(coarse, 1000);
  // The same steps but for the rounding of their lengths.
  EXPECT_NEAR(q(fine, 0, 0), q(coarse, 0, 0), 1e-12);
  EXPECT_NEAR(q(fine, 0, 1), q(coarse, 0, 1), 1e-12);
}

TEST(Twin, AutoChoosesTheExactStepWhereThereIsOne) {
  const Twin twin(sceneOf(kThreeSystems));
  EXPECT_EQ(twin.systems()[0]->integrator, "exponential");
  EXPECT_EQ(twin.systems()[1]->integrator, "gauss_legendre_6");
  EXPECT_EQ(twin.systems()[2]->integrator, "gauss_legendre_6");
  for (const SharedSystem& system : twin.systems()) {
    EXPECT_NE(system->integrator_reason, "");
  }
  Scene damped = sceneOf(kThreeSystems);
  damped.systems[0].parameters["internal_damping"] = 1.0;
  EXPECT_EQ(Twin(damped).systems()[0]->integrator, "exponential")
      << "its matrices change with the speed, but there is a table of them";
}

struct Fatal {
  const char* name;
  const char* integrator;
  double rate;
  double stiffness;
};

void PrintTo(const Fatal& f, std::ostream* out) {
  *out << f.name;
}

class FailingSystem : public testing::TestWithParam<Fatal> {};

TEST_P(FailingSystem, StopsAloneAndKeepsItsLastGoodState) {
  Scene scene = sceneOf(kThreeSystems);
  SystemSpec doomed = scene.systems[0];
  doomed.name = "doomed";
  doomed.integrator = GetParam().integrator;
  doomed.parameters["stiffness"] = doomed.parameters["stiffness_y"] = GetParam().stiffness;
  doomed.v = {GetParam().rate, 0.0};
  scene.systems.insert(scene.systems.begin(), doomed);
  Twin twin(scene);
  Twin healthy(sceneOf(kThreeSystems));
  std::vector<double> last = record(twin);
  int steps = 0;
  while (twin.status(0) == StepStatus::kOk) {
    ASSERT_LT(steps, 3000) << "it should have failed";
    last = record(twin);
    twin.step();
    healthy.step();
    ++steps;
  }
  EXPECT_NE(describe(twin.status(0))[0], '\0');
  run(twin, 500);
  run(healthy, 500);
  const std::vector<double> now = record(twin);
  const SystemView stopped = twin.layout().system(now.data(), 0);
  const SystemView good = twin.layout().system(last.data(), 0);
  EXPECT_EQ(stopped.status(), twin.status(0));
  for (std::size_t i = 0; i < SystemView::motionSize(2); ++i) {
    EXPECT_EQ(stopped.motion()[i], good.motion()[i]) << "kept";
    EXPECT_TRUE(std::isfinite(stopped.motion()[i]));
  }
  EXPECT_EQ(twin.stepCount(), steps + 500);
  for (std::size_t system = 0; system < 3; ++system) {
    EXPECT_EQ(twin.status(system + 1), StepStatus::kOk);
    EXPECT_EQ(q(twin, system + 1, 0), q(healthy, system, 0)) << "the others go on";
  }
  twin.reset();
  EXPECT_EQ(twin.status(0), StepStatus::kOk);
}

INSTANTIATE_TEST_SUITE_P(
    Causes, FailingSystem,
    testing::Values(Fatal{"VerletBeyondItsLimit", "velocity_verlet", 1.0, 1e9},
                    Fatal{"EulerBeyondItsLimit", "semi_implicit_euler", 1.0, 1e9},
                    Fatal{"RungeKuttaBeyondItsLimit", "runge_kutta_4", 1.0, 1e9},
                    Fatal{"AbsurdRate", "runge_kutta_4", 1e306, 1e9},
                    Fatal{"AbsurdRateOfTheExactStep", "exponential", 1.7e308, 1e9},
                    Fatal{"AbsurdRateOfAnImplicitStep", "gauss_legendre_6", 1e306, 1e9}),
    [](const auto& test) { return test.param.name; });

TEST(PendulumAtAnAbsurdRate, IsStoppedWhateverTheMethod) {
  for (const char* method :
       {"semi_implicit_euler", "velocity_verlet", "runge_kutta_4", "gauss_legendre_6"}) {
    Twin twin(sceneOf(
        "{step: 0.001, systems: {a: {model: double_pendulum, integrator: " + std::string(method) +
        ", parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}, "
        "initial: {theta1: 1, theta1_rate: 1e300}}}}"));
    run(twin, 3);
    EXPECT_NE(twin.status(0), StepStatus::kOk) << method;
    EXPECT_EQ(q(twin, 0, 0), 1.0) << method;
  }
}

TEST(SetSpeed, IsContinuousInSpeedAndAccelerationAndBoundInBoth) {
  Twin twin(sceneOf(kThreeSystems));
  double speed = twin.drive(0).at(0.0).speed;
  double acceleration = 0.0;
  const double limit = 50.0;
  const double jerk = 500.0;
  for (int i = 0; i < 6000; ++i) {
    if (i % 500 == 100) {  // in the middle of moves as well as at rest
      ASSERT_TRUE(twin.setSpeed(0, (i / 500) % 2 == 0 ? 80.0 : -20.0, limit, jerk));
    }
    const ShaftMotion set = twin.drive(0).at(0.0);
    EXPECT_NEAR(set.speed, speed, 1e-12 * 80.0) << "step " << i;
    EXPECT_NEAR(set.acceleration, acceleration, 1e-12 * limit) << "step " << i;
    EXPECT_LE(std::abs(set.acceleration), limit * (1.0 + 1e-12));
    EXPECT_LE(std::abs(set.jerk), jerk);
    const ShaftMotion next = twin.drive(0).at(0.001);
    speed = next.speed;
    acceleration = next.acceleration;
    twin.step();
  }
  for (std::size_t system = 0; system < 3; ++system) {
    EXPECT_EQ(twin.status(system), StepStatus::kOk);
  }
}

TEST(SetSpeed, RefusesWhatIsOutOfRange) {
  Twin twin(sceneOf(kThreeSystems));
  EXPECT_FALSE(twin.setSpeed(1, 1.0, 1.0, 1.0)) << "no such drive";
  EXPECT_FALSE(twin.setSpeed(0, NAN, 1.0, 1.0));
  EXPECT_FALSE(twin.setSpeed(0, 1e7, 1.0, 1.0));
  EXPECT_FALSE(twin.setSpeed(0, 1.0, 0.0, 1.0));
  EXPECT_FALSE(twin.setSpeed(0, 1.0, 1.0, -1.0));
  EXPECT_EQ(twin.drive(0).targetSpeed(), 12.0) << "nothing changed";
}

}  // namespace twin_test
}  // namespace whirl_twin
