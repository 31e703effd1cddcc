// The operating point is the end point of the damped motion, not the nearest equilibrium.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/equilibria.h"
#include "hoop_bead.h"
#include "mechanics/lagrangian_dynamics.h"

namespace whirl_twin {
namespace operating_point_test {

constexpr double kPi = 3.14159265358979323846;

struct Hoop {
  hoop::HoopBead bead{0.1, 0.2, 0.01, 0.02, 9.81};
  double speed = 8.0;

  /// Outward force on the bead, per m r: w^2 (e + r sin) cos - g sin.
  double pull(double angle) const {
    return speed * speed * (bead.offset + bead.radius * std::sin(angle)) * std::cos(angle) -
           bead.gravity * std::sin(angle);
  }
  /// Where the bead comes to rest, moved by Euler's method as by honey.
  double creptTo(double angle) const {
    for (int i = 0; i < 200'000; ++i) {
      angle += 1.0e-3 * pull(angle);
    }
    return angle;
  }
};

Eigen::VectorXd one(double x) {
  return Eigen::VectorXd::Constant(1, x);
}

TEST(OperatingPoint, IsWhereABeadOnAHoopBesideItsAxisComesTo) {
  const Hoop h;
  const LagrangianDynamics<hoop::HoopBead> dynamics(h.bead);
  int nearer_ones = 0;
  for (double start = -3.0; start < 3.1; start += 0.1) {
    const auto point = operatingPoint(dynamics, one(start), one(0.0), h.speed);
    ASSERT_TRUE(point.has_value()) << start;
    const double end = h.creptTo(start);
    EXPECT_NEAR(std::remainder(point->q[0] - end, 2.0 * kPi), 0.0, 1.0e-9) << start;
    for (const Equilibrium& e : equilibria(dynamics, h.speed)) {
      nearer_ones += e.stability.bounded() && std::fabs(std::remainder(e.q[0] - start, 2.0 * kPi)) <
                                                  std::fabs(std::remainder(end - start, 2.0 * kPi));
    }
  }
  EXPECT_GT(nearer_ones, 0);  // else the nearest would have done
}

// With friction the swing is lost: the motion itself ends there.
TEST(OperatingPoint, IsWhereTheMotionOfTheBeadEnds) {
  const Hoop h;
  const LagrangianDynamics<hoop::HoopBead> dynamics(h.bead);
  for (const double start : {-0.3, 0.0, 0.4}) {
    double angle = start;
    double rate = 0.0;
    const EvaluationPoint<double> at{0.0, 0.0, h.speed, 0.0};
    for (int i = 0; i < 400'000; ++i) {  // semi-implicit Euler, 40 s
      rate += 1.0e-4 * dynamics.acceleration(one(angle), one(rate), at)[0];
      angle += 1.0e-4 * rate;
    }
    const auto point = operatingPoint(dynamics, one(start), one(0.0), h.speed);
    ASSERT_TRUE(point.has_value());
    EXPECT_NEAR(point->q[0], angle, 1.0e-6) << start;
  }
}

}  // namespace operating_point_test
}  // namespace whirl_twin
