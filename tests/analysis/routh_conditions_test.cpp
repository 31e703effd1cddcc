// The notes' conditions decide as Routh's table does, exactly, on every polynomial.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "analysis/routh.h"
#include "analysis/routh_table.h"
#include "hurwitz_minors.h"
#include "messages/input_error.h"
#include "reference_polynomials.h"

namespace whirl_twin {
namespace routh_conditions_test {

using Polynomial = std::vector<Rational>;

bool allHold(const std::vector<RouthCondition>& conditions) {
  return std::all_of(conditions.begin(), conditions.end(),
                     [](const RouthCondition& c) { return c.holds; });
}

bool stable(const Polynomial& polynomial) {
  return routh(polynomial).verdict == Verdict::kAsymptoticallyStable;
}

TEST(RouthConditions, AgreeWithTheTableOnTheReferencePolynomials) {
  int tested = 0;
  for (const auto& reference : referenceCases("routh_cases.json")) {
    const int degree = reference["degree"];
    if (degree > kMaxConditionDegree) {
      continue;
    }
    const Polynomial exact = exactCoefficients(reference["coefficients"]);
    EXPECT_EQ(allHold(routhConditions(exact)), reference["verdict"] == "asymptotically_stable")
        << reference["name"];
    ++tested;
  }
  EXPECT_GT(tested, 60);
}

TEST(RouthConditions, AgreeWithTheTableOnRandomPolynomials) {
  // Products of factors with small whole coefficients: many on the boundary, most near it.
  std::mt19937 random(31);
  std::uniform_int_distribution<int> near_stable(-1, 6);
  std::uniform_int_distribution<int> scale(1, 3);
  int stable_ones = 0;
  const int trials = 6000;
  for (int trial = 0; trial < trials; ++trial) {
    const int degree = 1 + trial % kMaxConditionDegree;
    Polynomial polynomial{scale(random) * (trial % 5 == 0 ? -1 : 1)};
    int left = degree;
    for (; left >= 2; left -= 2) {
      polynomial = product<Rational>(polynomial, {1, near_stable(random), near_stable(random)});
    }
    if (left == 1) {
      polynomial = product<Rational>(polynomial, {1, near_stable(random)});
    }
    // Half of them moved off their factors, by a little.
    if (trial % 2 == 1) {
      polynomial[polynomial.size() - 1 - trial % polynomial.size() / 2] +=
          Rational(near_stable(random), 100);
    }
    if (polynomial.front() == 0) {
      continue;
    }
    const bool expected = stable(polynomial);
    stable_ones += expected ? 1 : 0;
    EXPECT_EQ(allHold(routhConditions(polynomial)), expected) << trial;
  }
  // Both answers are tested.
  EXPECT_GT(stable_ones, trials / 10);
  EXPECT_LT(stable_ones, trials * 9 / 10);
}

TEST(RouthConditions, AgreeWithTheTableOnRandomDoubles) {
  std::mt19937 random(32);
  std::lognormal_distribution<double> positive(0.0, 1.0);
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<double> polynomial(2 + trial % kMaxConditionDegree);
    for (double& c : polynomial) {
      c = positive(random);
    }
    EXPECT_EQ(allHold(routhConditions(polynomial)),
              routh(polynomial).verdict == Verdict::kAsymptoticallyStable)
        << trial;
  }
}

TEST(RouthConditions, AreTheHurwitzDeterminants) {
  // Quintic: D2 and D4; sextic: D3 and A5 D5.
  const Polynomial quintic{1, 4, 7, 9, 5, 2};
  const std::vector<RouthCondition> five = routhConditions(quintic);
  const std::vector<Rational> five_minors = hurwitzMinors(quintic);
  EXPECT_EQ(five[5].left - five[5].right, toDouble(five_minors[1]));
  EXPECT_EQ(five[6].left - five[6].right, toDouble(five_minors[3]));
  const Polynomial sextic{1, 3, 9, 11, 17, 8, 5};
  const std::vector<RouthCondition> six = routhConditions(sextic);
  const std::vector<Rational> six_minors = hurwitzMinors(sextic);
  EXPECT_EQ(six[6].left - six[6].right, toDouble(six_minors[2]));
  EXPECT_EQ(six[7].left - six[7].right, 3.0 * toDouble(six_minors[4]));
}

TEST(RouthConditions, OfTheNotesExamples) {
  // s^3 + 3 s^2 + 4 s + 2: A1 A2 = 12 > 2.
  const std::vector<RouthCondition> cubic = routhConditions(Polynomial{1, 3, 4, 2});
  ASSERT_EQ(cubic.size(), 4u);
  EXPECT_EQ(cubic[0].name, "A0 > 0");
  EXPECT_EQ(cubic[3].name, "A1 A2 > A0");
  EXPECT_EQ(cubic[3].left, 12.0);
  EXPECT_EQ(cubic[3].right, 2.0);
  EXPECT_TRUE(cubic[3].holds);
  // 6, 18, 24, 16: 2592 > 576 + 576, where the misprint would give 576 + 93312.
  const RouthCondition quartic = routhConditions(Polynomial{1, 6, 18, 24, 16}).back();
  EXPECT_EQ(quartic.left, 2592.0);
  EXPECT_EQ(quartic.right, 1152.0);
  EXPECT_TRUE(quartic.holds);
}

TEST(RouthConditions, OnTheBoundaryDoNotHold) {
  // (s^2 + 4)(s + 1)^n: an imaginary pair.
  Polynomial polynomial{1, 0, 4};
  for (int degree = 3; degree <= kMaxConditionDegree; ++degree) {
    polynomial = product<Rational>(polynomial, {1, 1});
    const RouthCondition last = routhConditions(polynomial).back();
    EXPECT_FALSE(last.holds) << degree;
    EXPECT_EQ(last.left, last.right) << degree;
  }
}

TEST(RouthConditions, RefuseOtherDegrees) {
  EXPECT_THROW(routhConditions(Polynomial{5}), InputError);
  EXPECT_THROW(routhConditions(Polynomial{0, 0}), InputError);
  EXPECT_THROW(routhConditions(Polynomial(8, 1)), InputError);
  EXPECT_THROW(routhConditions(std::vector<double>{1.0, NAN}), InputError);
  EXPECT_EQ(routhConditions(Polynomial{0, 0, 2, 4}).size(), 1u);  // leading zeros dropped
}

}  // namespace routh_conditions_test
}  // namespace whirl_twin
