#include <gtest/gtest.h>

#include <random>

#include "analysis/routh.h"
#include "messages/input_error.h"
#include "reference_polynomials.h"

namespace whirl_twin {
namespace routh_complex_test {

using nlohmann::json;
using Polynomial = std::vector<ComplexRational>;

ComplexRational multiply(const ComplexRational& a, const ComplexRational& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

class ReferenceComplexPolynomial : public ::testing::TestWithParam<json> {};

TEST_P(ReferenceComplexPolynomial, HasTheKnownCounts) {
  const json& known = GetParam();
  Polynomial polynomial;
  for (const json& coefficient : known["coefficients"]) {
    polynomial.push_back({parseRational(coefficient[0]), parseRational(coefficient[1])});
  }
  const RouthResult result = routh(polynomial);
  EXPECT_EQ(result.right, known["n_right"]);
  EXPECT_EQ(result.imaginary, known["n_imag"]);
  EXPECT_EQ(result.left, known["n_left"]);
}

INSTANTIATE_TEST_SUITE_P(Routh, ReferenceComplexPolynomial,
                         ::testing::ValuesIn(referenceCases("routh_cases_complex.json")),
                         [](const auto& test) { return testName(test.param["name"]); });

TEST(RouthComplex, AnIsotropicUndampedRotorIsMarginalInTheComplexCoordinate) {
  // z'' + w0^2 z = 0; the same rotor in x and y has (s^2 + w0^2)^2, which looks repeated.
  EXPECT_EQ(routh(Polynomial{{1, 0}, {0, 0}, {100, 0}}).verdict, Verdict::kMarginal);
  EXPECT_EQ(routh(std::vector<double>{1, 0, 200, 0, 10000}).verdict, Verdict::kRepeatedImaginary);
}

TEST(RouthComplex, AtTheEdgeOfGyroscopicStabilisationTheRootIsRepeated) {
  // (s - i)^2
  const RouthResult result = routh(Polynomial{{1, 0}, {0, -2}, {-1, 0}});
  EXPECT_EQ(result.verdict, Verdict::kRepeatedImaginary);
  EXPECT_EQ(result.largest_imaginary_multiplicity, 2);
}

TEST(RouthComplex, SecondOrderColumnIsTheCriterionOfFrankAndBilharz) {
  // s^2 + (a1 + i b1) s + a2 + i b2 is stable if a1 > 0 and a1^2 a2 + a1 b1 b2 - b2^2 > 0; with
  // a1 = 2, b1 = 1, a2 = 3, b2 = 5 the latter is -3 and the last entry of the column -3 / a1^2.
  const RouthResult result = routh(Polynomial{{1, 0}, {2, 1}, {3, 5}});
  EXPECT_EQ(result.right, 1);
  EXPECT_EQ(result.first_column, (std::vector<double>{1, 2, -0.75}));
}

TEST(RouthComplex, InternalDampingBeyondItsThresholdLosesForwardWhirlOnly) {
  // m = 1, ce = ci = 2, k = 10^4: threshold w0 (1 + ce/ci) = 200 rad/s; stiffness k - i ci W.
  EXPECT_EQ(routh(Polynomial{{1, 0}, {4, 0}, {10000, -400}}).verdict, Verdict::kMarginal);
  const RouthResult above = routh(Polynomial{{1, 0}, {4, 0}, {10000, Rational(-400001, 1000)}});
  EXPECT_EQ(above.right, 1);
  EXPECT_EQ(above.left, 1);
}

TEST(RouthComplex, DegreeZeroHasNoRoots) {
  const RouthResult result = routh(Polynomial{{0, 0}, {0, -3}});
  EXPECT_EQ(result.verdict, Verdict::kAsymptoticallyStable);
  EXPECT_EQ(result.right + result.imaginary + result.left, 0);
}

TEST(RouthComplex, RefusesAPolynomialWithoutCoefficients) {
  EXPECT_THROW(routh(Polynomial{}), InputError);
  EXPECT_THROW(routh(Polynomial{{0, 0}, {0, 0}}), InputError);
}

TEST(RouthComplex, RandomRootsAreCountedWhereTheyWerePutWhateverTheComplexFactor) {
  std::mt19937 random{7};
  const auto rational = [&](int low, int high) {
    return Rational(std::uniform_int_distribution<int>(low, high)(random),
                    std::uniform_int_distribution<int>(1, 5)(random));
  };
  for (int i = 0; i < 500; ++i) {
    Polynomial polynomial{{rational(-3, 3), rational(1, 3)}};
    int right = 0;
    int imaginary = 0;
    int left = 0;
    const int degree = std::uniform_int_distribution<int>(1, 7)(random);
    while (static_cast<int>(polynomial.size()) <= degree) {
      // Small numbers, so that repeated roots and pairs symmetric to the axis are common.
      const ComplexRational root{rational(-2, 2), rational(-2, 2)};
      (root.re > 0 ? right : root.re < 0 ? left : imaginary) += 1;
      polynomial.push_back({0, 0});
      for (std::size_t k = polynomial.size() - 1; k > 0; --k) {
        const ComplexRational shift = multiply(polynomial[k - 1], root);
        polynomial[k] = {polynomial[k].re - shift.re, polynomial[k].im - shift.im};
      }
    }
    const RouthResult result = routh(polynomial);
    ASSERT_EQ(result.right, right) << "polynomial " << i;
    ASSERT_EQ(result.imaginary, imaginary) << "polynomial " << i;
    ASSERT_EQ(result.left, left) << "polynomial " << i;
  }
}

}  // namespace routh_complex_test
}  // namespace whirl_twin
