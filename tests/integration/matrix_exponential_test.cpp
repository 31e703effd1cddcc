// e^X - I and the integral of a quadratic form, against matrices with known exponentials.
#include "integration/matrix_exponential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace whirl_twin {
namespace matrix_exponential_test {

using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;

TEST(MatrixExponential, TurnsByAnAngle) {
  for (const double angle : {1e-12, 1e-8, 1e-3, 0.4, 1.0, 3.0, 30.0, 300.0}) {
    Matrix2 x;
    x << 0.0, -angle, angle, 0.0;
    const Matrix2 e = exponentialLessIdentity<2>(x);
    // Each doubling doubles the relative error of the angle turned.
    const double tolerance = 4e-16 * std::max(1.0, angle);
    const double half = std::sin(0.5 * angle);
    // cos - 1 of a small angle keeps its own digits: it is not the rounding of a number near 1.
    const double small = std::min(1.0, angle);
    EXPECT_NEAR(e(0, 0), -2.0 * half * half, tolerance * small * small) << angle;
    EXPECT_NEAR(e(1, 0), std::sin(angle), tolerance * small) << angle;
    EXPECT_NEAR(e(0, 1), -e(1, 0), tolerance * small) << angle;
    EXPECT_NEAR(e(1, 1), e(0, 0), tolerance * small * small) << angle;
  }
}

TEST(MatrixExponential, OfADiagonalIsTheExponentialOfEach) {
  const Eigen::Vector3d rates(-20.0, -1e-9, 5.0);
  const Matrix3 e = exponentialLessIdentity<3>(Matrix3(rates.asDiagonal()));
  for (int i = 0; i < 3; ++i) {
    // Up to 6 doublings, each of them two roundings.
    EXPECT_NEAR(e(i, i), std::expm1(rates[i]), 1e-14 * std::abs(std::expm1(rates[i])));
    for (int j = 0; j < 3; ++j) {
      EXPECT_TRUE(i == j || e(i, j) == 0.0);
    }
  }
}

TEST(MatrixExponential, OfANilpotentMatrixIsAPolynomial) {
  for (const double h : {1e-6, 0.1, 1.0, 1000.0}) {
    Matrix3 x = Matrix3::Zero();
    x(0, 1) = x(1, 2) = h;
    Matrix3 expected = x;
    expected(0, 2) = 0.5 * h * h;
    EXPECT_LT((exponentialLessIdentity<3>(x) - expected).norm(), 1e-15 * expected.norm()) << h;
  }
}

TEST(MatrixExponential, OfADefectiveMatrixHasTheSecularTerm) {
  for (const double rate : {-3.0, -0.01, 2.0}) {
    Matrix2 x;
    x << rate, 1.0, 0.0, rate;
    const Matrix2 e = exponentialLessIdentity<2>(x);
    EXPECT_NEAR(e(0, 0), std::expm1(rate), 4e-15 * std::exp(rate));
    EXPECT_NEAR(e(0, 1), std::exp(rate), 4e-15 * std::exp(rate));
    EXPECT_EQ(e(1, 0), 0.0);
  }
}

// No number of halvings brings an infinity below one half.
TEST(MatrixExponential, OfWhatIsNotFiniteIsNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double entry : {kInfinity, -kInfinity, std::nan("")}) {
    const Matrix2 x = Matrix2::Constant(entry);
    EXPECT_EQ(halvings<2>(x), 0);
    EXPECT_FALSE(exponentialLessIdentity<2>(x).allFinite());
    EXPECT_FALSE((quadraticIntegral<2>(x, Matrix2::Identity(), 1.0).allFinite()));
  }
}

TEST(MatrixExponential, StepsCompose) {
  const Matrix3 x = 2.0 * Matrix3::Random();
  const Matrix3 i = Matrix3::Identity();
  const Matrix3 once = exponentialLessIdentity<3>(x) + i;
  const Matrix3 twice = exponentialLessIdentity<3>(Matrix3(2.0 * x)) + i;
  EXPECT_LT((once * once - twice).norm(), 1e-14 * twice.norm());
}

// integral of e^(A't) S e^(At) by three Gauss-Legendre points in each of many intervals.
template <int N>
Eigen::Matrix<double, N, N> quadrature(const Eigen::Matrix<double, N, N>& a,
                                       const Eigen::Matrix<double, N, N>& s, double h) {
  using Matrix = Eigen::Matrix<double, N, N>;
  constexpr int kIntervals = 2000;
  Matrix sum = Matrix::Zero();
  for (int k = 0; k < kIntervals; ++k) {
    for (const int node : {-1, 0, 1}) {
      const double t = h / kIntervals * (k + 0.5 + node * std::sqrt(0.15));
      const Matrix e = exponentialLessIdentity<N>(Matrix(t * a)) + Matrix::Identity();
      sum += h / kIntervals * (node == 0 ? 8.0 / 18.0 : 5.0 / 18.0) * (e.transpose() * s * e);
    }
  }
  return sum;
}

class QuadraticIntegral : public testing::TestWithParam<double> {};

TEST_P(QuadraticIntegral, IsTheQuadrature) {
  const double h = GetParam();
  // A damped whirl driven by a turning phasor, scaled as a rotor's is.
  Eigen::Matrix4d a;
  a << 0.0, 10.0, 0.0, 0.0,   //
      -10.0, -1.0, 2.0, 0.3,  //
      0.0, 0.0, 0.0, -7.0,    //
      0.0, 0.0, 7.0, 0.0;
  Eigen::Matrix4d s;
  s << 1.0, 0.2, 0.0, -0.4,  //
      0.2, -2.0, 0.5, 0.0,   //
      0.0, 0.5, 0.0, 0.1,    //
      -0.4, 0.0, 0.1, 3.0;
  const Eigen::Matrix4d w = quadraticIntegral<4>(a, s, h);
  const Eigen::Matrix4d expected = quadrature<4>(a, s, h);
  // The quadrature's own error: (frequency x interval)^6 / 2e6, with rounding.
  EXPECT_LT((w - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT((w - w.transpose()).norm(), 4e-14 * w.norm());
}

INSTANTIATE_TEST_SUITE_P(Steps, QuadraticIntegral, testing::Values(1e-6, 1e-3, 0.1, 1.0, 5.0),
                         [](const auto& test) { return "Case" + std::to_string(test.index); });

}  // namespace matrix_exponential_test
}  // namespace whirl_twin
