// The exact step of a linear system given by its matrices: on the closed form for every step from a
// microsecond to ten seconds, at undamped resonance and with rigid-body modes.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "linear_systems.h"

namespace whirl_twin {
namespace linear_exact_step_test {

struct Run {
  double step;  // [s]
  long steps;
};

void PrintTo(const Run& run, std::ostream* out) {
  *out << run.steps << " steps of " << run.step << " s";
}

class ExactLinearStep : public testing::TestWithParam<Run> {
 protected:
  double end() const { return GetParam().step * static_cast<double>(GetParam().steps); }
  LinearMotion run(const LinearModel& model, const LinearMotion& start) const {
    return after(model, "exponential", GetParam().step, GetParam().steps, start);
  }
};

TEST_P(ExactLinearStep, GrowsWithTimeAtUndampedResonance) {
  const double m = 2.0;
  const double p = 16.0;
  const double force = 3.0;
  const LinearMotion found = run(drivenMass(m, p, force, p), LinearMotion(1));
  const double t = end();
  const double growth = force * t / (2.0 * m * p);
  // The phase p t is known to 1e-16 p t; below a thousandth of a period by the rounding of p t sin.
  const double tolerance = 1e-15 * growth * (20.0 + p * t);
  EXPECT_NEAR(found.q()[0], growth * std::sin(p * t), tolerance);
  EXPECT_NEAR(found.v()[0], growth * (p * std::cos(p * t) + std::sin(p * t) / t), p * tolerance);
}

TEST_P(ExactLinearStep, SwingsInTwoFrequenciesBesideResonance) {
  const double m = 0.5;
  const double p = 9.0;
  const double w = 2.0;
  const double force = 1.0;
  const LinearMotion found = run(drivenMass(m, p, force, w), LinearMotion(1));
  const double amplitude = force / (m * (p * p - w * w));
  EXPECT_NEAR(found.q()[0], amplitude * (std::cos(w * end()) - std::cos(p * end())),
              1e-15 * amplitude * (20.0 + p * end()));
}

TEST_P(ExactLinearStep, LetsARigidBodyDriftAndFall) {
  // Two masses on a spring in free flight under a constant force on one: the centre of mass falls
  // by F t^2 / (2 m), the spring swings about its static length.
  LinearModel model = freeMasses(2);
  model.mass.diagonal() << 1.0, 3.0;
  model.stiffness << 48.0, -48.0, -48.0, 48.0;  // p^2 = k (1/m1 + 1/m2) = 64
  model.forces = {{Eigen::VectorXd::Unit(2, 0) * 2.0, 0.0, 0.0}};
  LinearMotion start(2);
  start.v() << 0.25, 0.25;
  const LinearMotion found = run(model, start);
  const double t = end();
  const double centre = 0.25 * t + 0.5 * (2.0 / 4.0) * t * t;
  const double stretch = (4.0 / 64.0) * std::pow(std::sin(4.0 * t), 2);
  // A spring constant rounded to 1e-16 makes the free motion fall by 1e-16 (p t)^2 of itself.
  const double tolerance = 2e-16 * centre * (20.0 + 64.0 * t * t);
  EXPECT_NEAR((found.q()[0] + 3.0 * found.q()[1]) / 4.0, centre, tolerance);
  EXPECT_NEAR(found.q()[0] - found.q()[1], stretch, tolerance);
}

TEST_P(ExactLinearStep, IsThatOfOneLongStep) {
  const LinearModel model = fullSystem(8);
  const LinearMotion start = startOf(model);
  const LinearMotion once = after(model, "exponential", end(), 1, start);
  const LinearMotion found = run(model, start);
  const double scale = start.q().norm() + 0.1 * start.v().norm();
  EXPECT_LT((found.q() - once.q()).norm(), 1e-13 * scale * (1.0 + end()));
  EXPECT_LT((found.v() - once.v()).norm(), 1e-12 * scale * (1.0 + end()));
  EXPECT_NEAR(found.work.high, once.work.high, 1e-12 * energy(model, start) * (1.0 + end()));
}

INSTANTIATE_TEST_SUITE_P(Steps, ExactLinearStep,
                         testing::Values(Run{1e-6, 1}, Run{1e-6, 200000}, Run{1e-3, 20000},
                                         Run{0.1, 100}, Run{1.0, 50}, Run{10.0, 10}));

TEST(ExactLinearStepOfAStiffSystem, IsOnTheClosedFormOfEachMode) {
  // Frequencies of 1 and 1e4 rad/s and a mode overdamped by 1e3, in steps far longer than two of
  // them.
  LinearModel model = freeMasses(3);
  model.mass.diagonal() << 1.0, 1e-4, 2.0;
  model.stiffness.diagonal() << 1.0, 1e4, 8.0;
  model.damping(2, 2) = 2.0 * 1e3 * 2.0 * 2.0;
  LinearMotion start(3);
  start.q() << 1.0, 1e-3, 0.5;
  const LinearMotion end = after(model, "exponential", 0.1, 200, start);
  const double t = 20.0;
  EXPECT_NEAR(end.q()[0], std::cos(t), 1e-13);
  // 2e5 rad at 1e-16 of the frequency each.
  EXPECT_NEAR(end.q()[1], 1e-3 * std::cos(1e4 * t), 1e-3 * 2e-10);
  const double fast = 2.0 * (1e3 + std::sqrt(1e6 - 1.0));  // decay rates, product 4 [1/s^2]
  const double slow = 4.0 / fast;
  EXPECT_NEAR(end.q()[2],
              0.5 * (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow),
              1e-12);
}

TEST(ExactLinearStep, LosesNoPhaseInAMillionSteps) {
  const double p = 40.0;
  const double w = 31.0;
  const LinearMotion end =
      after(drivenMass(1.0, p, 1.0, w), "exponential", 1e-3, 1000000, LinearMotion(1));
  const double amplitude = 1.0 / (p * p - w * w);
  // 4e4 rad at 1e-16 each, and the time of each step as a product in doubles.
  EXPECT_NEAR(end.q()[0], amplitude * (std::cos(w * 1e3) - std::cos(p * 1e3)), 1e-10 * amplitude);
}

}  // namespace linear_exact_step_test
}  // namespace whirl_twin
