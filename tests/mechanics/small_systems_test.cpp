// Well-known small systems, against the theory of their motion.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "../analysis/models_under_test.h"
#include "../integration/running_system.h"
#include "analysis/equilibria.h"
#include "integration/driven_equation.h"
#include "mechanics/pendulums/spinning_pendulum.h"

namespace whirl_twin {
namespace small_systems_test {

constexpr std::int64_t kMillisecond = 1'000'000;  // ns
constexpr double kGravity = 9.81;                 // m/s^2

RunningSystem::Setup setup(const std::string& model, const ParameterValues& parameters,
                           std::vector<double> q) {
  RunningSystem::Setup s;
  s.model = model;
  s.parameters = parameters;
  s.gravity = kGravity;
  s.q = std::move(q);
  return s;
}

// Its steps do not depend on the angle, as declared (kHasShaftAngle).
TEST(SpinningPendulum, MovesAlikeWhateverTheAngleOfItsShaft) {
  static_assert(!SpinningPendulum::kHasShaftAngle);
  const SpinningPendulum pendulum{1.2, 0.7, 0.05, kGravity};
  const auto motion = [&](double angle) {
    return derivative(pendulum, std::array{0.4}, std::array{-1.3},
                      EvaluationPoint<double>{2.0, angle, 5.0, 0.8});
  };
  EXPECT_EQ(motion(std::nan("")).acceleration[0], motion(0.0).acceleration[0]);
  EXPECT_EQ(motion(std::nan("")).power, motion(0.0).power);
  EXPECT_NEAR(motion(0.0).acceleration[0],
              25.0 * std::sin(0.4) * std::cos(0.4) - kGravity / 0.7 * std::sin(0.4) +
                  0.05 * 1.3 / (1.2 * 0.7 * 0.7),
              1e-13);
}

TEST(MassSpringDamper, RingsOutAsTheTextbookSays) {
  const double m = 2.0, k = 300.0, c = 4.0, x0 = 0.1;
  RunningSystem body(
      setup("mass_spring_damper", {{"mass", m}, {"stiffness", k}, {"damping", c}}, {x0}),
      "exponential", kMillisecond);
  ASSERT_EQ(body.run(1234), StepStatus::kOk);
  const double decay = c / (2.0 * m);
  const double rate = std::sqrt(k / m - decay * decay);
  const double t = body.time();
  EXPECT_NEAR(body.q(0),
              x0 * std::exp(-decay * t) * (std::cos(rate * t) + decay / rate * std::sin(rate * t)),
              1e-13 * x0);
}

TEST(MassSpringDamper, FrictionTakesTheSameLengthInEveryTurn) {
  // 4 F / k, until the spring is weaker than the friction; the turns last as without friction.
  const double m = 1.0, k = 100.0, friction = 0.5, x0 = 0.105;
  RunningSystem body(
      setup("mass_spring_damper",
            {{"mass", m}, {"stiffness", k}, {"friction_force", friction}, {"friction_width", 1e-6}},
            {x0}),
      "gauss_legendre_6", kMillisecond / 10);
  const double period = 2.0 * M_PI * std::sqrt(m / k);
  const auto turn = static_cast<std::int64_t>(std::lround(period / 1e-4));
  for (int turns = 1; turns <= 4; ++turns) {
    ASSERT_EQ(body.run(turn), StepStatus::kOk);
    EXPECT_NEAR(body.q(0), x0 - turns * 4.0 * friction / k, 2e-5) << turns;
  }
  ASSERT_EQ(body.run(4 * turn), StepStatus::kOk);
  const double rest = body.q(0);
  EXPECT_LE(std::fabs(rest), friction / k);
  ASSERT_EQ(body.run(turn), StepStatus::kOk);
  EXPECT_NEAR(body.q(0), rest, 1e-5) << "it sticks";
}

TEST(ElasticPendulum, BouncesAndSwingsWhereItHangs) {
  const double m = 0.7, k = 90.0, free = 0.4;
  const double l = free + m * kGravity / k;
  const auto pendulum = dynamicsOf(
      "elastic_pendulum", {{"mass", m}, {"stiffness", k}, {"free_length", free}}, kGravity);
  const Eigen::VectorXd rest = Eigen::Vector2d(l, 0.0);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(2);
  EXPECT_LT(pendulum->residualForce(rest, zero, {}).norm(), 1e-13 * m * kGravity);
  const Linearization about = pendulum->linearization(rest, zero, zero, {});
  EXPECT_NEAR(about.stiffness(0, 0) / about.mass(0, 0), k / m, 1e-12 * k / m);
  EXPECT_NEAR(about.stiffness(1, 1) / about.mass(1, 1), kGravity / l, 1e-12 * kGravity / l);
}

/// Largest swing [rad] in a minute of a bounce that began with hardly any.
double largestSwing(double stiffness_of_resonance) {
  const double m = 1.0, l = 0.5;
  const double k = stiffness_of_resonance * 4.0 * m * kGravity / l;
  RunningSystem bob(setup("elastic_pendulum",
                          {{"mass", m}, {"stiffness", k}, {"free_length", l - m * kGravity / k}},
                          {1.1 * l, 1e-4}),
                    "dormand_prince_8", kMillisecond);
  double largest = 0.0;
  for (int i = 0; i < 60000; ++i) {
    EXPECT_EQ(bob.run(1), StepStatus::kOk);
    largest = std::max(largest, std::fabs(bob.q(1)));
  }
  return largest;
}

TEST(ElasticPendulum, FeedsItsSwingWhereItBouncesTwiceAsFast) {
  EXPECT_GT(largestSwing(1.0), 0.1);
  EXPECT_LT(largestSwing(2.0), 5e-4);
}

/// Kapitza's: l = 0.1 m, a = 2 mm, the pivot's speed a Omega relative to sqrt(2 g l).
ParameterValues shaken(double part) {
  const double l = 0.1, a = 0.002;
  return {{"mass", 0.1},
          {"length", l},
          {"amplitude", a},
          {"frequency", part * std::sqrt(2.0 * kGravity * l) / a}};
}

/// Largest distance from upright [rad] in 10 s.
double fall(double part) {
  RunningSystem bob(setup("kapitza_pendulum", shaken(part), {M_PI - 0.01}), "dormand_prince_8",
                    kMillisecond / 5);
  double largest = 0.0;
  for (int i = 0; i < 50000 && largest < 1.0; ++i) {
    EXPECT_EQ(bob.run(1), StepStatus::kOk);
    largest = std::max(largest, std::fabs(bob.q(0) - M_PI));
  }
  return largest;
}

TEST(KapitzaPendulum, StandsOnItsHeadFromTheThresholdOn) {
  EXPECT_GE(fall(0.95), 1.0);
  EXPECT_LT(fall(1.05), 0.05);
}

TEST(KapitzaPendulum, IsJudgedByItsMeanMotion) {
  for (const double part : {0.99, 1.01, 2.0}) {
    const auto pendulum = dynamicsOf("kapitza_pendulum", shaken(part), kGravity);
    const Dynamics& mean = pendulum->atMeanLoad();
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
    const Eigen::VectorXd upright = Eigen::VectorXd::Constant(1, M_PI);
    const Linearization about = mean.linearization(upright, zero, zero, {});
    // a^2 Omega^2 / 2 l^2 - g / l
    EXPECT_NEAR(about.stiffness(0, 0) / about.mass(0, 0), (part * part - 1.0) * kGravity / 0.1,
                1e-9);
  }
}

TEST(KapitzaPendulum, HasABarrierBetweenHangingAndUprightAboveTheThreshold) {
  EXPECT_EQ(equilibria(*dynamicsOf("kapitza_pendulum", shaken(0.8), kGravity), 0.0).size(), 2u);
  const auto all = equilibria(*dynamicsOf("kapitza_pendulum", shaken(2.0), kGravity), 0.0);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[0].q[0], -std::acos(-0.25), 1e-9);  // acos(-2 g l / a^2 Omega^2)
  EXPECT_NEAR(all[2].q[0], std::acos(-0.25), 1e-9);
}

TEST(KapitzaPendulum, SwaysAboutUprightAsItsMeanMotion) {
  const ParameterValues fast = shaken(3.0);
  RunningSystem bob(setup("kapitza_pendulum", fast, {M_PI - 0.02}), "dormand_prince_8",
                    kMillisecond / 10);
  // Half a sway: theta - pi has changed its sign.
  const double rate = std::sqrt((9.0 - 1.0) * kGravity / 0.1);
  ASSERT_EQ(bob.run(std::llround(M_PI / rate / 1e-4)), StepStatus::kOk);
  // The ripple is a / l of the lean, the mean motion's next order (sqrt(g/l) / Omega)^2.
  EXPECT_NEAR(bob.q(0) - M_PI, 0.02, 0.02 * 0.05);
}

/// Rotation of its plane [rad] at the end of a swing after `swings` of them.
double turned(double latitude, double rate, double length, double lean, int swings) {
  RunningSystem bob(
      setup("foucault_pendulum",
            {{"mass", 1.0}, {"length", length}, {"latitude", latitude}, {"rotation_rate", rate}},
            {length * std::tan(lean), 0.0}),
      "dormand_prince_8", kMillisecond);
  const double period = 2.0 * M_PI * std::sqrt(length / kGravity);
  EXPECT_EQ(bob.run(std::llround(swings * period / 1e-3)), StepStatus::kOk);
  // The position of largest radius within the next swing.
  double far = 0.0, angle = 0.0;
  for (int i = 0; i < std::lround(0.5 * period / 1e-3); ++i) {
    EXPECT_EQ(bob.run(1), StepStatus::kOk);
    const double x = bob.q(0);
    const double y = bob.q(1);
    if (std::hypot(x, y) > far) {
      far = std::hypot(x, y);
      angle = std::atan(y / x) / bob.time();
    }
  }
  return angle;
}

TEST(FoucaultPendulum, TurnsItsPlaneByTheSineOfTheLatitude) {
  const double rate = 0.005;
  for (const double latitude : {0.5 * M_PI, 0.8526, 0.3, 0.0, -0.8526}) {
    EXPECT_NEAR(turned(latitude, rate, 2.0, 0.02, 20), -rate * std::sin(latitude), 2e-3 * rate)
        << latitude;
  }
}

TEST(FoucaultPendulum, OfThePantheonTurnsElevenDegreesAnHour) {
  const double hour = 3600.0 * 180.0 / M_PI;
  // An hour would be 219 swings; twenty are enough for the rate.
  EXPECT_NEAR(hour * turned(0.8526, 7.292115e-5, 67.0, 0.04, 20), -11.3, 0.05);
}

TEST(FoucaultPendulum, WithoutRotationItSwingsInItsPlane) {
  EXPECT_NEAR(turned(0.8526, 0.0, 1.0, 0.3, 10), 0.0, 1e-12);
}

}  // namespace small_systems_test
}  // namespace whirl_twin
