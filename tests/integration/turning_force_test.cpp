// The phasor of a shaft from step to step, and synchronous forces, against the sines and cosines
// and the equations that they replace.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "control/shaft_angle.h"
#include "integration/shaft_phasor.h"
#include "integration/synchronous_force.h"

namespace whirl_twin {
namespace turning_force_test {

// 16 products, each rounding by some 1e-16, and as many differences of angles by 4e-16.
TEST(ShaftPhasor, IsWhereTheShaftIs) {
  for (const double speed : {80.0, -3.3, 2500.0, 0.0, 1.0e5}) {
    ShaftPhasor phasor;
    phasor.prepare(speed * 1.0e-3);
    double worst = 0.0;
    for (std::int64_t i = 0; i < 200000; ++i) {
      const double angle = advance({0, 0.25}, speed, i * 1'000'000).remainder;
      phasor.turnTo(angle);
      worst = std::fmax(
          worst, std::hypot(phasor.cosine() - std::cos(angle), phasor.sine() - std::sin(angle)));
    }
    EXPECT_LT(worst, 8.0e-15) << speed;
  }
}

TEST(ShaftPhasor, FollowsAShaftThatDoesWhatWasNotForeseen) {
  ShaftPhasor phasor;
  phasor.prepare(0.08);
  for (const double angle : {0.0, 0.08, 0.16, 3.0, 3.08, 3.08, 3.1600001, 6.2, 6.28, 0.0768147}) {
    phasor.turnTo(angle);
    EXPECT_NEAR(phasor.cosine(), std::cos(angle), 1.0e-15) << angle;
    EXPECT_NEAR(phasor.sine(), std::sin(angle), 1.0e-15) << angle;
  }
}

using Array = std::array<double, 2>;

Array unbalanced(const EvaluationPoint<double>& at) {
  const double force = at.speed * at.speed;
  const double c = std::cos(at.angle + 0.3);
  const double s = std::sin(at.angle + 0.3);
  return {1.0e-4 * (force * c + at.acceleration * s) + 0.02 * std::cos(at.angle - 1.0),
          1.0e-4 * (force * s - at.acceleration * c) + 0.02 * std::sin(at.angle - 1.0) - 9.8};
}

TEST(SynchronousForce, IsThatOfTheEquations) {
  SynchronousForce<2> force;
  ASSERT_TRUE(force.find(unbalanced, 128.0));
  for (const EvaluationPoint<double>& at :
       {EvaluationPoint<double>{0.0, 0.0, 0.0, 0.0}, EvaluationPoint<double>{3.0, 2.0, -70.0, 40.0},
        EvaluationPoint<double>{5.0, 5.5, 900.0, -1000.0}}) {
    const Array expected = unbalanced(at);
    const Array found = force.at(at);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(found[i], expected[i], 1.0e-14 * (10.0 + 1.0e-4 * at.speed * at.speed));
    }
  }
}

TEST(SynchronousForce, RefusesWhatTurnsOtherwise) {
  SynchronousForce<2> force;
  EXPECT_FALSE(force.find(
      [](const EvaluationPoint<double>& at) {
        return Array{std::cos(2.0 * at.angle), 0.0};
      },
      128.0));
  EXPECT_FALSE(force.find(
      [](const EvaluationPoint<double>& at) {
        return Array{std::cos(at.angle), 1.0e-6 * std::sin(50.0 * at.time)};
      },
      128.0));
  EXPECT_FALSE(force.find(
      [](const EvaluationPoint<double>& at) {
        return Array{1.0e-4 * at.speed * at.speed * std::cos(at.angle), 0.0};
      },
      128.0))
      << "no tangential part";
}

}  // namespace turning_force_test
}  // namespace whirl_twin
