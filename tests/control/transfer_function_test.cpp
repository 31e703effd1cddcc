// Transfer functions in state space: their samples satisfy the difference equation, and their
// frequency response is that of the transfer function.
#include "control/transfer_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <deque>
#include <random>
#include <stdexcept>

#include "algebra/dense.h"

namespace whirl_twin {
namespace transfer_function_test {

using Complex = std::complex<double>;
using Eigen::VectorXd;

Complex response(const DiscreteStateSpace& law, Complex z) {
  const Eigen::MatrixXcd pencil =
      z * Eigen::MatrixXcd::Identity(law.states(), law.states()) - law.a.cast<Complex>();
  return (law.c.cast<Complex>() * ComplexLu(pencil).solve(law.b.cast<Complex>().eval()) +
          law.d.cast<Complex>())(0, 0);
}

// a0 u(k) = b0 y(k) + b1 y(k - 1) + ... - a1 u(k - 1) - ..., for degrees 0 to 5.
TEST(TransferFunction, IsItsDifferenceEquation) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (Eigen::Index n = 0; n <= 5; ++n) {
    for (Eigen::Index m = 0; m <= n; ++m) {
      VectorXd b = VectorXd::NullaryExpr(m + 1, [&] { return number(random); });
      VectorXd a = VectorXd::NullaryExpr(n + 1, [&] { return 0.3 * number(random); });
      a[0] = -2.0;
      const DiscreteStateSpace law = discreteTransferFunction(b, a);
      ASSERT_EQ(law.states(), n);
      std::deque<double> y(static_cast<std::size_t>(n) + 1, 0.0);
      std::deque<double> u(static_cast<std::size_t>(n) + 1, 0.0);
      VectorXd x = VectorXd::Zero(n);
      for (int k = 0; k < 50; ++k) {
        y.push_front(number(random));
        double next = 0.0;
        for (Eigen::Index i = 0; i <= m; ++i) {
          next += b[i] * y[static_cast<std::size_t>(n - m + i)];
        }
        for (Eigen::Index i = 1; i <= n; ++i) {
          next -= a[i] * u[static_cast<std::size_t>(i - 1)];
        }
        u.push_front(next / a[0]);
        ASSERT_NEAR((law.c * x)(0) + law.d(0, 0) * y[0], u[0], 1e-13) << n << " " << m;
        x = (law.a * x + law.b * y[0]).eval();
      }
    }
  }
}

TEST(TransferFunction, RefusesWhatIsNotProper) {
  EXPECT_THROW(discreteTransferFunction(VectorXd::Ones(3), VectorXd::Ones(2)), std::logic_error);
  EXPECT_THROW(discreteTransferFunction(VectorXd::Ones(1), Eigen::Vector2d(0, 1)),
               std::logic_error);
  EXPECT_THROW(discreteTransferFunction(VectorXd::Ones(1), VectorXd()), std::logic_error);
}

// Tustin: at z = e^(j w T) it is the response at j (2 / T) tan(w T / 2); with a prewarp at that
// frequency at j w itself.
TEST(Lead, IsThatOfContinuousTimeAtAWarpedFrequency) {
  constexpr double kPeriod = 0.01;
  const auto continuous = [](double w) {
    return 4.0 * (1.0 + Complex(0, w / 30.0)) / (1.0 + Complex(0, w / 170.0));
  };
  const DiscreteStateSpace plain = discreteLead(4.0, 30.0, 170.0, kPeriod, 0.0);
  const DiscreteStateSpace warped = discreteLead(4.0, 30.0, 170.0, kPeriod, 120.0);
  for (const double w : {1e-6, 10.0, 71.0, 120.0, 300.0}) {
    const Complex z = std::polar(1.0, w * kPeriod);
    EXPECT_LT(
        std::abs(response(plain, z) - continuous(2.0 / kPeriod * std::tan(0.5 * w * kPeriod))),
        1e-12);
  }
  EXPECT_LT(std::abs(response(warped, std::polar(1.0, 120.0 * kPeriod)) - continuous(120.0)),
            1e-12);
  EXPECT_LT(std::abs(response(warped, 1.0) - 4.0), 1e-12);
}

TEST(OnEachAxis, CouplesNothing) {
  const DiscreteStateSpace one =
      discreteTransferFunction(Eigen::Vector2d(1, 2), Eigen::Vector3d(1, 0.5, 0.1));
  const DiscreteStateSpace three = onEachAxis(one, 3);
  ASSERT_EQ(three.states(), 6);
  EXPECT_EQ(three.a.block(2, 2, 2, 2), one.a);
  EXPECT_EQ(three.a.block(2, 0, 2, 2).norm(), 0.0);
  EXPECT_EQ(three.b.col(1).segment(2, 2), one.b);
  EXPECT_EQ(three.b.col(1).norm(), one.b.norm());
  EXPECT_EQ(three.c.row(2).norm(), one.c.norm());
  EXPECT_EQ(onEachAxis(discreteTransferFunction(VectorXd::Ones(1), VectorXd::Ones(1)), 2).d,
            Eigen::MatrixXd::Identity(2, 2));
}

}  // namespace transfer_function_test
}  // namespace whirl_twin
