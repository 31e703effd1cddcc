#include "analysis/stability_margins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "analysis/polynomial_roots.h"
#include "analysis/routh.h"
#include "messages/input_error.h"
#include "reference_polynomials.h"

namespace whirl_twin {
namespace stability_margins_test {

using nlohmann::json;
using Complex = std::complex<double>;

/// The largest multiplicity of any root: how often gcd(p, p') can be taken.
int largestMultiplicity(ExactPolynomial polynomial) {
  ExactBudget plenty(1.0e12);
  int multiplicity = 0;
  while (polynomial.entry.size() > 1) {
    polynomial = sturmSequence(polynomial, derivative(polynomial), plenty).back();
    ++multiplicity;
  }
  return multiplicity;
}

/// Tolerance of the margins relative to the rightmost root. Simple roots: 1e-17, a hundred
/// roundings of extended precision (measured: below 1e-18). A root of multiplicity m keeps 1/m of
/// the digits: (s + a)^m is known to 2^m roundings, so the root to 2 eps^(1/m); twice that.
double relativeTolerance(const std::vector<double>& coefficients) {
  const std::vector<Rational> exact(coefficients.begin(), coefficients.end());
  const int multiplicity = largestMultiplicity(trimmed(scaledIntegers(exact)));
  constexpr double kExtendedEpsilon = 1.1e-19;
  return multiplicity > 1 ? 4.0 * std::pow(kExtendedEpsilon, 1.0 / multiplicity) : 1e-17;
}

class ReferenceMargin : public ::testing::TestWithParam<json> {};

TEST_P(ReferenceMargin, DecayRateAndDampingRatioAreTheKnownOnes) {
  const json& known = GetParam()["double"];
  const std::vector<double> coefficients = roundedCoefficients(GetParam()["coefficients"]);
  const double relative = relativeTolerance(coefficients);
  const double size = std::abs(roots(coefficients).front());
  const double sigma = numberOf(known["sigma_star"]);
  // 1e-14: the rounding to double, and the condition of the Bessel polynomial of order 20.
  EXPECT_NEAR(decayRate(coefficients), sigma, relative * size + 1e-14 * std::fabs(sigma));
  const double zeta = numberOf(known["zeta_min"]);
  if (std::isnan(zeta)) {
    EXPECT_TRUE(std::isnan(dampingRatio(coefficients)));
  } else {
    EXPECT_NEAR(dampingRatio(coefficients), zeta, relative + 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(Margins, ReferenceMargin,
                         ::testing::ValuesIn(referenceCases("routh_cases.json")),
                         [](const auto& test) { return testName(test.param["name"]); });

class ReferenceComplexMargin : public ::testing::TestWithParam<json> {};

TEST_P(ReferenceComplexMargin, DecayRateIsTheKnownOne) {
  std::vector<Complex> coefficients;
  for (const json& coefficient : GetParam()["coefficients"]) {
    coefficients.emplace_back(numberOf(coefficient[0]), numberOf(coefficient[1]));
  }
  const double size = std::abs(roots(coefficients).front());
  // The known values are of the decimal coefficients: their rounding to double costs some 1e-16 of
  // the root, and its square root where the root is double (gyro_edge).
  const bool repeated = GetParam()["name"] == "gyro_edge";
  EXPECT_NEAR(decayRate(coefficients), numberOf(GetParam()["sigma_star"]),
              (repeated ? 1e-9 : 1e-15) * size);
}

INSTANTIATE_TEST_SUITE_P(Margins, ReferenceComplexMargin,
                         ::testing::ValuesIn(referenceCases("routh_cases_complex.json")),
                         [](const auto& test) { return testName(test.param["name"]); });

TEST(Roots, AreRightmostFirstInExactPairsWithExactZeros) {
  // s (s + 3) (s^2 + 2s + 5)
  const std::vector<Complex> found = roots(std::vector<double>{0, 1, 5, 11, 15, 0});
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0], Complex(0.0, 0.0));
  EXPECT_EQ(found[1], std::conj(found[2]));
  EXPECT_NEAR(std::abs(found[1] - Complex(-1.0, 2.0)), 0.0, 1e-15);
  EXPECT_EQ(found[3].imag(), 0.0);
  EXPECT_NEAR(found[3].real(), -3.0, 1e-15);
}

TEST(Roots, OfVeryDifferentSizeAreAllFoundToFullPrecision) {
  // (s + 1e-150) (s + 1) (s + 1e150), coefficients right to 1e-150.
  const std::vector<Complex> found = roots(std::vector<double>{1, 1e150, 1e150, 1});
  ASSERT_EQ(found.size(), 3u);
  const double sizes[] = {1e-150, 1.0, 1e150};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i].real(), -sizes[i], 1e-15 * sizes[i]);
    EXPECT_EQ(found[i].imag(), 0.0);
  }
}

TEST(Roots, OfOrderFortyLieOnTheirCircle) {
  std::vector<double> coefficients(41, 0.0);
  coefficients.front() = 1.0;
  coefficients.back() = 1.0;
  const std::vector<Complex> found = roots(coefficients);
  ASSERT_EQ(found.size(), 40u);
  for (const Complex& root : found) {
    EXPECT_NEAR(std::abs(std::pow(root, 40) + 1.0), 0.0, 1e-13);  // 40 roundings
  }
}

TEST(Roots, LieWhereTheExactTestCountsThem) {
  // Random coefficients have no root near the axis compared with the accuracy of roots().
  std::mt19937 random{11};
  std::uniform_real_distribution<double> coefficient(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    std::vector<double> polynomial(2 + i % 20);
    std::generate(polynomial.begin(), polynomial.end(), [&] { return coefficient(random); });
    const std::vector<Complex> found = roots(polynomial);
    const auto right = std::count_if(found.begin(), found.end(),
                                     [](const Complex& root) { return root.real() > 0.0; });
    ASSERT_EQ(right, routh(polynomial).right) << "polynomial " << i;
  }
}

TEST(Roots, RefuseWhatIsNoPolynomial) {
  EXPECT_THROW(roots(std::vector<double>{}), InputError);
  EXPECT_THROW(roots(std::vector<Complex>{0.0}), InputError);
  EXPECT_THROW(decayRate(std::vector<double>{1, std::numeric_limits<double>::infinity()}),
               InputError);
}

TEST(DecayRate, OfAConstantIsInfiniteAndItHasNoDampingRatio) {
  EXPECT_EQ(decayRate(std::vector<double>{5}), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(dampingRatio(std::vector<double>{5})));
}

TEST(DampingRatio, DoesNotCountRigidBodyRotation) {
  // s^2 (s^2 + 2 zeta w s + w^2) with zeta = 0.1, w = 10 rad/s; 1e-15: rounded coefficients.
  EXPECT_NEAR(dampingRatio(std::vector<double>{1, 2, 100, 0, 0}), 0.1, 1e-15);
  EXPECT_EQ(decayRate(std::vector<double>{1, 2, 100, 0, 0}), 0.0);
}

TEST(LogDecrement, IsTheLogarithmOfTheRatioOfSuccessiveAmplitudes) {
  // One period 2 pi / (w sqrt(1 - zeta^2)) of decay at zeta w.
  EXPECT_NEAR(logDecrement(0.1), 2.0 * std::acos(-1.0) * 0.1 / std::sqrt(0.99), 1e-15);
  EXPECT_LT(logDecrement(-0.01), 0.0);
  EXPECT_EQ(logDecrement(0.0), 0.0);
}

TEST(LogDecrement, IsUndefinedWithoutVibration) {
  EXPECT_TRUE(std::isnan(logDecrement(1.0)));
  EXPECT_TRUE(std::isnan(logDecrement(-1.0)));
  EXPECT_TRUE(std::isnan(logDecrement(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace stability_margins_test
}  // namespace whirl_twin
