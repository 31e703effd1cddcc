#include "analysis/routh.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <limits>
#include <random>

#include "hurwitz_minors.h"
#include "messages/input_error.h"
#include "reference_polynomials.h"

namespace whirl_twin {
namespace routh_test {

using nlohmann::json;
using Polynomial = std::vector<Rational>;

int signChanges(const std::vector<double>& column) {
  int changes = 0;
  for (std::size_t i = 1; i < column.size(); ++i) {
    changes += std::signbit(column[i]) != std::signbit(column[i - 1]) ? 1 : 0;
  }
  return changes;
}

class ReferencePolynomial : public ::testing::TestWithParam<json> {};

TEST_P(ReferencePolynomial, HasTheKnownCountsAndVerdict) {
  const json& known = GetParam();
  const RouthResult result = routh(exactCoefficients(known["coefficients"]));
  EXPECT_EQ(result.right, known["n_right"]);
  EXPECT_EQ(result.imaginary, known["n_imag"]);
  EXPECT_EQ(result.left, known["n_left"]);
  EXPECT_EQ(result.largest_imaginary_multiplicity, known["max_mult_imag"]);
  EXPECT_EQ(name(result.verdict), known["verdict"]);
  // The column is that of the polynomial without its roots at zero.
  const int zeros = known["n_zero"];
  EXPECT_EQ(result.first_column.size(), known["degree"].get<std::size_t>() - zeros + 1);
  EXPECT_EQ(signChanges(result.first_column), result.right);
}

TEST_P(ReferencePolynomial, HasTheKnownCountsWhenRoundedToDouble) {
  const json& known = GetParam();
  const RouthResult result = routh(roundedCoefficients(known["coefficients"]));
  EXPECT_EQ(result.right, known["double"]["n_right"]);
  EXPECT_EQ(result.imaginary, known["double"]["n_imag"]);
  EXPECT_EQ(result.left, known["double"]["n_left"]);
  if (known["exact_in_double"]) {
    EXPECT_EQ(name(result.verdict), known["verdict"]);
  }
}

INSTANTIATE_TEST_SUITE_P(Routh, ReferencePolynomial,
                         ::testing::ValuesIn(referenceCases("routh_cases.json")),
                         [](const auto& test) { return testName(test.param["name"]); });

TEST(Routh, FirstColumnIsTheTextbookOne) {
  // a0, a1, (a1 a2 - a0 a3) / a1, a3 of 2s^3 + 3s^2 + 5s + 7.
  EXPECT_EQ(routh(std::vector<double>{2, 3, 5, 7}).first_column,
            (std::vector<double>{2, 3, 1.0 / 3.0, 7}));
}

TEST(Routh, ANegativeLeadingCoefficientTurnsTheSignOfAllOfThem) {
  EXPECT_EQ(routh(std::vector<double>{-2, -3, -5, -7}).first_column,
            (std::vector<double>{2, 3, 1.0 / 3.0, 7}));
}

TEST(Routh, RootsAtZeroAreTakenOutOfTheTable) {
  const RouthResult result = routh(std::vector<double>{0, 1, 3, 2, 0});
  EXPECT_EQ(result.verdict, Verdict::kMarginal);
  EXPECT_EQ(result.imaginary, 1);
  EXPECT_EQ(result.left, 2);
  EXPECT_EQ(result.first_column, (std::vector<double>{1, 3, 2}));
}

TEST(Routh, ARowThatBeginsWithZeroDoesNotNeedASmallNumber) {
  // (s^2+1) is a factor of it, and the method of a small epsilon counts four right roots.
  const RouthResult result = routh(std::vector<double>{1, 1, 3, 3, 3, 2, 1});
  EXPECT_EQ(result.right, 2);
  EXPECT_EQ(result.imaginary, 2);
  EXPECT_EQ(result.left, 2);
}

TEST(Routh, ARowThatBeginsWithTwoZerosIsFilledFromTheThirdEntry) {
  // s^5 + 1: a root at -1 and the others at +-36 and +-108 degrees.
  const RouthResult result = routh(std::vector<double>{1, 0, 0, 0, 0, 1});
  EXPECT_EQ(result.right, 2);
  EXPECT_EQ(result.imaginary, 0);
  EXPECT_EQ(result.left, 3);
}

TEST(Routh, AZeroRowIsReplacedByTheDerivativeOfTheAuxiliaryPolynomial) {
  // s^3 + 2s^2 + 4s + 8 = (s+2)(s^2+4): the row of s is zero, A = 2s^2 + 8, A' = 4s.
  const RouthResult result = routh(std::vector<double>{1, 2, 4, 8});
  EXPECT_EQ(result.verdict, Verdict::kMarginal);
  EXPECT_EQ(result.imaginary, 2);
  EXPECT_EQ(result.left, 1);
  EXPECT_EQ(result.first_column, (std::vector<double>{1, 2, 4, 8}));
}

TEST(Routh, ARepeatedImaginaryPairIsSeenBesideARightRoot) {
  // (s-1)(s^2+1)^2 (s^2-4): unstable, and its imaginary roots are double.
  const RouthResult result =
      routh(product<Rational>(product<Rational>({1, -1}, {1, 0, 2, 0, 1}), {1, 0, -4}));
  EXPECT_EQ(result.verdict, Verdict::kUnstable);
  EXPECT_EQ(result.right, 2);
  EXPECT_EQ(result.imaginary, 4);
  EXPECT_EQ(result.left, 1);
  EXPECT_EQ(result.largest_imaginary_multiplicity, 2);
}

TEST(Routh, AConstantHasNoRootsAndIsStable) {
  const RouthResult result = routh(std::vector<double>{0, -3});
  EXPECT_EQ(result.verdict, Verdict::kAsymptoticallyStable);
  EXPECT_EQ(result.right + result.imaginary + result.left, 0);
  EXPECT_EQ(result.first_column, std::vector<double>{3});
}

TEST(Routh, IsExactAtTheEndsOfTheRangeOfDouble) {
  // (s + 1)(s^2 + tiny): marginal; an upset of the last bit of tiny is not.
  const double tiny = DBL_TRUE_MIN;
  EXPECT_EQ(routh(std::vector<double>{1, 1, tiny, tiny}).verdict, Verdict::kMarginal);
  EXPECT_EQ(routh(std::vector<double>{1, 1, tiny, 2 * tiny}).verdict, Verdict::kUnstable);
  EXPECT_EQ(routh(std::vector<double>{1, 1, 2 * tiny, tiny}).verdict,
            Verdict::kAsymptoticallyStable);
}

TEST(Routh, FirstColumnBeyondTheRangeOfDoubleKeepsItsSign) {
  // b1 = a2 - a0 a3 / a1 = 1 - 1e616, too large for a double.
  const RouthResult result = routh(std::vector<double>{1e308, 1e-308, 1, 1});
  EXPECT_EQ(result.right, 2);
  EXPECT_EQ(result.first_column, (std::vector<double>{1e308, 1e-308, -DBL_MAX, 1}));
}

TEST(Routh, RefusesWhatIsNoPolynomial) {
  EXPECT_THROW(routh(std::vector<double>{}), InputError);
  EXPECT_THROW(routh(std::vector<double>{0, 0}), InputError);
  EXPECT_THROW(routh(std::vector<Rational>{}), InputError);
  try {
    routh(std::vector<double>{1, 2, std::numeric_limits<double>::quiet_NaN()});
    FAIL() << "accepted NaN";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "polynomial: coefficient 3 of 3 must be a finite number, found nan");
  }
}

TEST(Routh, HurwitzMinorsAreTheProductsOfTheFirstColumn) {
  const std::vector<Rational> minors = hurwitzMinors({2, 3, 5, 7, 1});
  const std::vector<double> column = routh(Polynomial{2, 3, 5, 7, 1}).first_column;
  double product_of_column = 1.0;
  ASSERT_EQ(minors.size() + 1, column.size());
  for (std::size_t k = 0; k < minors.size(); ++k) {
    product_of_column *= column[k + 1];
    // Four products, each rounded once.
    EXPECT_NEAR(toDouble(minors[k]), product_of_column, 1e-14 * std::fabs(product_of_column));
  }
}

/// A polynomial built from rational roots, and where they lie.
struct Built {
  Polynomial polynomial{1};
  int right = 0;
  int imaginary = 0;
  int left = 0;

  void add(const Polynomial& factor, int sign_of_real_part) {
    polynomial = product(polynomial, factor);
    const int count = static_cast<int>(factor.size()) - 1;
    (sign_of_real_part > 0 ? right : sign_of_real_part < 0 ? left : imaginary) += count;
  }
};

class RandomRoots : public ::testing::Test {
 protected:
  Rational rational(int low, int high) {
    return Rational(std::uniform_int_distribution<int>(low, high)(random_),
                    std::uniform_int_distribution<int>(1, 7)(random_));
  }

  /// Up to four factors s - x or (s - x)^2 + y^2; a third of them on the axis, many repeated.
  Built build() {
    Built built;
    const int factors = std::uniform_int_distribution<int>(1, 4)(random_);
    for (int i = 0; i < factors; ++i) {
      const bool on_axis = rational(1, 3) == 1;
      const Rational x = on_axis ? Rational(0) : rational(-4, 4);
      const Rational y = rational(0, 3);
      const int times = std::uniform_int_distribution<int>(1, 2)(random_);
      for (int j = 0; j < times; ++j) {
        built.add(y == 0 ? Polynomial{1, -x} : Polynomial{1, -2 * x, x * x + y * y}, x.sign());
      }
    }
    return built;
  }

  std::mt19937 random_{2024};
};

TEST_F(RandomRoots, AreCountedWhereTheyWerePutWhateverTheScaleOfValueAndTime) {
  for (int i = 0; i < 500; ++i) {
    const Built built = build();
    Rational factor = rational(-9, 9);
    factor = factor == 0 ? Rational(-1, 3) : factor;
    const Rational time_scale = rational(1, 1000);
    Polynomial scaled = built.polynomial;
    Rational power = factor;
    for (auto coefficient = scaled.rbegin(); coefficient != scaled.rend(); ++coefficient) {
      *coefficient *= power;
      power *= time_scale;
    }
    for (const Polynomial& polynomial : {built.polynomial, scaled}) {
      const RouthResult result = routh(polynomial);
      ASSERT_EQ(result.right, built.right) << "polynomial " << i;
      ASSERT_EQ(result.imaginary, built.imaginary) << "polynomial " << i;
      ASSERT_EQ(result.left, built.left) << "polynomial " << i;
      ASSERT_EQ(signChanges(result.first_column), built.right) << "polynomial " << i;
    }
  }
}

TEST_F(RandomRoots, AreTheSameForTheComplexTest) {
  for (int i = 0; i < 500; ++i) {
    const Built built = build();
    std::vector<ComplexRational> complex;
    for (const Rational& coefficient : built.polynomial) {
      complex.push_back({-coefficient, 0});
    }
    const RouthResult real = routh(built.polynomial);
    const RouthResult generalised = routh(complex);
    ASSERT_EQ(real.verdict, generalised.verdict) << "polynomial " << i;
    ASSERT_EQ(real.right, generalised.right) << "polynomial " << i;
    ASSERT_EQ(real.imaginary, generalised.imaginary) << "polynomial " << i;
    ASSERT_EQ(real.left, generalised.left) << "polynomial " << i;
    ASSERT_EQ(real.largest_imaginary_multiplicity, generalised.largest_imaginary_multiplicity);
    // Equal columns in the regular case; the special cases change the real table.
    if (generalised.first_column.size() == real.first_column.size()) {
      for (std::size_t k = 0; k < real.first_column.size(); ++k) {
        ASSERT_DOUBLE_EQ(real.first_column[k], generalised.first_column[k]) << "polynomial " << i;
      }
    }
  }
}

}  // namespace routh_test
}  // namespace whirl_twin
