// Along any motion the Jacobi integral h = v . dL/dv - L changes by the work done:
// dh/dt = input power - dissipated power.
#include <gtest/gtest.h>

#include <cmath>

#include "../analysis/models_under_test.h"
#include "random_state.h"

namespace whirl_twin {
namespace energy_balance_test {

class EnergyBalanceOf : public testing::TestWithParam<VariantUnderTest> {};

TEST_P(EnergyBalanceOf, PowerIsTheRateOfTheJacobiIntegral) {
  std::mt19937_64 random(1836);
  for (int i = 0; i < 1000; ++i) {
    const RandomState s = randomState(GetParam(), random);
    const auto a = s.dynamics->acceleration(s.q, s.v, s.at);
    // A curve through the state with the motion's rates: dh/dt needs no more.
    const auto jacobi = [&](double d) {
      const EvaluationPoint<double> at{s.at.time + d,
                                       s.at.angle + d * (s.at.speed + 0.5 * d * s.at.acceleration),
                                       s.at.speed + d * s.at.acceleration, s.at.acceleration};
      return s.dynamics->energies(s.q + d * s.v, s.v + d * a, at).jacobi;
    };
    const auto difference = [&](double d) { return (jacobi(d) - jacobi(-d)) / (2.0 * d); };
    // Time scale of the motion: differences over a small part of it.
    const double d = 1e-3 / (1.0 + s.v.norm() + std::abs(s.at.speed) + std::sqrt(a.norm()) +
                             a.norm() / (1.0 + s.v.norm()));
    const double rate = (4.0 * difference(0.5 * d) - difference(d)) / 3.0;
    const Energies e = s.dynamics->energies(s.q, s.v, s.at);
    // Truncation 1e-12, rounding 1e-16 / 1e-3 of the energies per time scale.
    const double size =
        (std::abs(e.kinetic) + std::abs(e.potential) + std::abs(e.jacobi)) * 1e-3 / d;
    ASSERT_NEAR(e.input_power - e.dissipated_power, rate, 1e-10 * size) << "state " << i;
    // A rotating shaft adds terms linear in the rates; the energy of the spin itself is excluded.
    EvaluationPoint<double> standing = s.at;
    standing.speed = 0.0;
    ASSERT_GE(s.dynamics->energies(s.q, s.v, standing).kinetic, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EnergyBalanceOf, testing::ValuesIn(everyVariant()),
                         [](const auto& test) { return testName(test.param); });

TEST(EnergyBalanceOfSpinningPendulum, JacobiIntegralIsNotTheEnergy) {
  // h = m l^2 (th'^2 - w^2 sin^2 th)/2 + m g l (1 - cos th): the shaft's motor does the rest.
  std::mt19937_64 random(1969);
  for (int i = 0; i < 100; ++i) {
    const RandomState s = randomState("spinning_pendulum", random);
    const double l = s.parameters.at("length");
    const double m = s.parameters.at("mass");
    const double across = s.at.speed * std::sin(s.q[0]);
    const Energies e = s.dynamics->energies(s.q, s.v, s.at);
    const double scale = e.kinetic + e.potential;
    EXPECT_NEAR(e.kinetic, 0.5 * m * l * l * (s.v[0] * s.v[0] + across * across), 1e-14 * scale);
    EXPECT_NEAR(e.potential, m * s.gravity * l * (1.0 - std::cos(s.q[0])), 1e-14 * scale);
    EXPECT_NEAR(e.jacobi, e.kinetic + e.potential - m * l * l * across * across, 1e-14 * scale);
    EXPECT_NEAR(e.dissipated_power, s.parameters.at("damping") * s.v[0] * s.v[0],
                1e-14 * e.dissipated_power);
  }
}

TEST(EnergyBalanceOfRotor, ExternalDampingTakesAndRotatingDampingMayGive) {
  // Rotating damping takes energy with reference to the shaft; to the fixed frame it gives as soon
  // as the shaft overtakes the whirl: -v . ci (v - w x r) > 0.
  const auto rotor = dynamicsOf("jeffcott_rotor",
                                {{"mass", 1.0},
                                 {"stiffness", 100.0},
                                 {"stiffness_y", 100.0},
                                 {"damping", 0.0},
                                 {"damping_y", 0.0},
                                 {"internal_damping", 1.0},
                                 {"eccentricity", 0.0},
                                 {"eccentricity_angle", 0.0}},
                                0.0);
  const Eigen::Vector2d q(0.01, 0.0);
  const Eigen::Vector2d v(0.0, 0.1);  // forward whirl at 10 rad/s
  const auto power = [&](double speed) {
    const Energies e = rotor->energies(q, v, {0.0, 0.0, speed, 0.0});
    return e.input_power - e.dissipated_power;
  };
  EXPECT_LT(power(5.0), 0.0);
  EXPECT_NEAR(power(10.0), 0.0, 1e-18);
  EXPECT_GT(power(15.0), 0.0);
}

}  // namespace energy_balance_test
}  // namespace whirl_twin
