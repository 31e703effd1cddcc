// The shortest and the longest step a scene may have, a nanosecond and ten seconds.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "../integration/running_system.h"
#include "../integration/whirl_closed_form.h"
#include "../scene/scenes.h"
#include "measured.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace step_sizes_test {

using Complex = ClosedFormWhirl::Complex;

struct Rotor {
  double p, zeta, speed, eccentricity;

  RunningSystem::Setup setup() const {
    RunningSystem::Setup s;
    s.model = "jeffcott_rotor";
    s.parameters = {{"mass", 1.0},
                    {"stiffness", p * p},
                    {"damping", 2.0 * zeta * p},
                    {"eccentricity", eccentricity}};
    s.speed = speed;
    s.q = {1e-3, -5e-4};
    s.v = {0.0, 1e-3 * p};
    return s;
  }
  Complex at(long double t) const {
    const RunningSystem::Setup s = setup();
    const ClosedFormWhirl whirl(s.parameters.at("damping"), s.parameters.at("stiffness"),
                                static_cast<long double>(eccentricity) * speed * speed, speed,
                                Complex(s.q[0], s.q[1]), Complex(s.v[0], s.v[1]));
    return whirl(t);
  }
};

class EveryMethodAtAStepSize : public testing::TestWithParam<std::string> {};

// A million steps of a nanosecond: a millisecond, p t = 0.1. Each adds 1e-7 of the radius, and its
// rounding must not be lost, nor the truncation of first order, (p h) p t = 1e-8, be more than it
// is.
TEST_P(EveryMethodAtAStepSize, AMillionStepsOfANanosecondAreAMillisecond) {
  const Rotor rotor{100.0, 0.05, 80.0, 1e-4};
  RunningSystem system(rotor.setup(), GetParam(), 1);
  ASSERT_EQ(system.run(1000000), StepStatus::kOk);
  EXPECT_EQ(system.time(), 1e-3);
  const Complex exact = rotor.at(1e-3L);
  const double error =
      static_cast<double>(std::abs(Complex(system.q(0), system.q(1)) - exact) / std::abs(exact));
  expectWithin((orderOf(GetParam()) == 1 ? 1e-8 : 0.0) + 1e-15, error,
               "1e6 steps of 1 ns by " + GetParam() + ", relative error");
}

// A slow rotor, p = 0.001 rad/s, by steps of 10 s: p h = 0.01. After a day and more, p t = 100.
TEST_P(EveryMethodAtAStepSize, AHundredThousandSecondsInStepsOfTen) {
  const Rotor rotor{0.001, 0.0, 0.0007, 1e-4};
  RunningSystem system(rotor.setup(), GetParam(), 10 * kSecond);
  double error = 0.0;
  for (int i = 1; i <= 10; ++i) {
    ASSERT_EQ(system.run(1000), StepStatus::kOk);
    const Complex exact = rotor.at(1e4L * i);
    error =
        std::fmax(error, static_cast<double>(std::abs(Complex(system.q(0), system.q(1)) - exact)));
  }
  const double radius = 2e-3;
  // Semi-implicit Euler's radius is off by half of p h besides.
  const double bound =
      100.0 * detuning(GetParam(), 0.01) + (orderOf(GetParam()) == 1 ? 0.005 : 0.0) + 1e-13;
  expectWithin(bound, error / radius,
               "1e5 s in steps of 10 s by " + GetParam() + ", error over radius");
}

INSTANTIATE_TEST_SUITE_P(Steps, EveryMethodAtAStepSize,
                         testing::ValuesIn(integratorsOf("jeffcott_rotor")),
                         [](const auto& test) { return test.param; });

// The exact step of a rotor of 1000 rad/s over ten seconds, 1600 turns.
TEST(AStepOfTenSeconds, IsExactForAFastRotor) {
  const Rotor rotor{1000.0, 1e-5, 1500.0, 1e-4};
  RunningSystem system(rotor.setup(), "exponential", 10 * kSecond);
  double error = 0.0;
  for (int i = 1; i <= 100; ++i) {
    ASSERT_EQ(system.run(1), StepStatus::kOk);
    const Complex exact = rotor.at(10.0L * i);
    error = std::fmax(
        error, static_cast<double>(std::abs(Complex(system.q(0), system.q(1)) - exact) / 1e-3));
  }
  // p t = 1e6, rounded by at least 1e-16; ten squarings and more in the step's exponential.
  expectWithin(1e-9, error, "p = 1000 rad/s in steps of 10 s, exact step, error over radius");
}

/// Of a twin of one rotor on a shaft that runs up to 90 rad/s in 180 s, then the same at that
/// speed.
std::vector<double> afterTenMinutes(const std::string& step, int steps) {
  Twin twin(sceneOf("{step: " + step +
                    ", drives: {shaft: {speed: 0.0, profile: [{speed: 90.0, max_acceleration: "
                    "0.5}]}}, systems: {rotor: {model: jeffcott_rotor, drive: shaft, integrator: "
                    "exponential, parameters: {mass: 1, stiffness: 2500, damping: 2.0, "
                    "eccentricity: 1.0e-5}}}}"));
  for (int i = 0; i < steps; ++i) {
    twin.step();
  }
  EXPECT_EQ(twin.status(0), StepStatus::kOk);
  EXPECT_EQ(twin.time(), 600.0);
  std::vector<double> record(twin.layout().size);
  twin.write(record.data());
  const ShaftAngle angle = twin.drive(0).angle();
  EXPECT_NEAR(angle.total(), 90.0 * 600.0 - 0.5 * 90.0 * 180.0, 1e-10);
  const double* q = twin.layout().system(record.data(), 0).q();
  return {q[0], q[1], q[2], q[3]};
}

// Steps of ten seconds do not resolve the critical speed they run through, 50 rad/s: the rotor has
// an arbitrary state afterwards, which decays. Then both converge to the same steady whirl.
TEST(TenMinutes, OfStepsOfTenSecondsAndOfAMillisecondEndInTheSameWhirl) {
  const std::vector<double> coarse = afterTenMinutes("10", 60);
  const std::vector<double> fine = afterTenMinutes("0.001", 600000);
  double error = 0.0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    error = std::fmax(error, std::fabs(coarse[i] / fine[i] - 1.0));
  }
  expectWithin(1e-11, error, "whirl after 600 s in steps of 10 s and of 1 ms, difference");
}

}  // namespace step_sizes_test
}  // namespace whirl_twin
