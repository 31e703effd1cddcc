// Stability of quartics in double precision, against the exact test and their prescribed roots.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "analysis/linearized_motion.h"
#include "analysis/routh.h"
#include "analysis/stability_margins.h"

namespace whirl_twin {
namespace quartic_test {

std::vector<double> asVector(const std::array<double, 5>& a) {
  return {a.begin(), a.end()};
}

/// a (s^2 + p s + q) (s^2 + r s + t).
std::array<double, 5> product(double a, double p, double q, double r, double t) {
  return {a, a * (p + r), a * (q + t + p * r), a * (p * t + q * r), a * q * t};
}

TEST(Quartic, VerdictIsNeverWrongAndSeldomInDoubt) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  int sure = 0;
  constexpr int kTrials = 20000;
  for (int i = 0; i < kTrials; ++i) {
    std::array<double, 5> a{};
    for (double& coefficient : a) {
      coefficient = std::exp(3.0 * normal(random)) * (normal(random) > -1.5 ? 1.0 : -1.0);
    }
    const QuarticJudgement judgement = judgeQuartic(a);
    if (judgement.sure) {
      ++sure;
      const RouthResult exact = routh(asVector(a));
      ASSERT_EQ(judgement.right, exact.right) << i;
      ASSERT_EQ(exact.imaginary, 0);
    }
  }
  EXPECT_GT(sure, 0.999 * kTrials);
}

TEST(Quartic, OnTheBoundaryItIsNotSure) {
  // Exactly, and within rounding.
  for (const double off : {0.0, 1.0e-17, -1.0e-17}) {
    EXPECT_FALSE(judgeQuartic(product(1.0, off, 2.0, 0.3, 5.0)).sure) << off;
  }
  EXPECT_TRUE(judgeQuartic(product(1.0, 1.0e-13, 2.0, 0.3, 5.0)).sure);
  EXPECT_EQ(judgeQuartic(product(1.0, 1.0e-13, 2.0, 0.3, 5.0)).right, 0);
  EXPECT_EQ(judgeQuartic(product(1.0, -1.0e-13, 2.0, 0.3, 5.0)).right, 2);
  EXPECT_FALSE(judgeQuartic({1.0, 2.0, 3.0, 4.0, 0.0}).sure) << "a root at zero";
  EXPECT_FALSE(judgeQuartic({0.0, 2.0, 3.0, 4.0, 1.0}).sure) << "no quartic";
  EXPECT_FALSE(judgeQuartic({1.0, std::nan(""), 3.0, 4.0, 1.0}).sure);
  EXPECT_FALSE(judgeQuartic({1.0, std::nan(""), 3.0, 4.0, 1.0}).factored);
}

TEST(Quartic, MarginsAreThoseOfTheRoots) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> damping(-0.2, 1.5), size(0.2, 5.0), unit(-8.0, 8.0);
  int factored = 0;
  constexpr int kTrials = 5000;
  for (int i = 0; i < kTrials; ++i) {
    const double scale = std::exp(unit(random));  // rad/s, from a turn in an hour to kilohertz
    const double w1 = scale * size(random), w2 = scale * size(random);
    const auto a = product(std::exp(unit(random)), 2.0 * damping(random) * w1, w1 * w1,
                           2.0 * damping(random) * w2, w2 * w2);
    const QuarticJudgement judgement = judgeQuartic(a);
    if (!judgement.factored) {
      continue;
    }
    ++factored;
    // Neighbouring roots are known to half the digits, by whatever method.
    const double decay = decayRate(asVector(a));
    ASSERT_NEAR(judgement.decay_rate, decay, 1.0e-7 * std::max(w1, w2)) << i;
    ASSERT_NEAR(judgement.damping_ratio, dampingRatio(asVector(a)), 1.0e-6) << i;
    ASSERT_EQ(judgement.decay_rate, -judgement.rightmost.real());
  }
  EXPECT_GT(factored, 0.99 * kTrials);
}

TEST(Quartic, OfAnIsotropicRotorBothFactorsAreOne) {
  for (const double damping : {1.0e-6, 0.01, 0.3, 1.0, 2.0}) {
    const double w = 57.0;
    const QuarticJudgement judgement =
        judgeQuartic(product(2.0, 2.0 * damping * w, w * w, 2.0 * damping * w, w * w));
    ASSERT_TRUE(judgement.factored) << damping;
    EXPECT_TRUE(judgement.sure);
    EXPECT_EQ(judgement.right, 0);
    const double decay =
        damping <= 1.0 ? damping * w : w / (damping + std::sqrt(damping * damping - 1.0));
    EXPECT_NEAR(judgement.decay_rate, decay, 1.0e-6 * w) << damping;
    EXPECT_NEAR(judgement.damping_ratio, std::min(1.0, damping), 1.0e-7) << damping;
    EXPECT_NEAR(judgement.largest, damping <= 1.0 ? w : w * w / decay, 1.0e-6 * w);
  }
}

TEST(Quartic, RootsOfVeryDifferentSize) {
  const QuarticJudgement judgement = judgeQuartic(product(1.0, 1.0e-6, 1.0e-8, 1.0e5, 1.0e8));
  ASSERT_TRUE(judgement.factored);
  EXPECT_NEAR(judgement.decay_rate, 5.0e-7, 1.0e-12);
  EXPECT_NEAR(judgement.rightmost.imag(), 1.0e-4, 1.0e-8);
}

}  // namespace quartic_test
}  // namespace whirl_twin
