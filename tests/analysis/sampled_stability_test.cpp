#include "analysis/sampled_stability.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "algebra/dense.h"
#include "analysis/balanced_matrix.h"
#include "loops_under_test.h"

namespace whirl_twin {
namespace sampled_stability_test {

using Eigen::MatrixXd;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;
using WideMatrix = Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic>;

ExactBudget unlimited() {
  return ExactBudget(std::numeric_limits<double>::infinity());
}

RouthResult circle(const std::vector<Rational>& polynomial) {
  ExactBudget budget = unlimited();
  return routhOfCircle(bilinearTransform(polynomial), budget);
}

TEST(UnitCircle, CountsWhatIsInsideOnAndOutside) {
  // (z - 1/2) (z + 2) (z^2 - z + 1) (z - 1) (z + 1)^2
  const RouthResult result = circle([] {
    std::vector<Rational> p{1};
    const auto times = [&](const std::vector<Rational>& factor) {
      std::vector<Rational> product(p.size() + factor.size() - 1);
      for (std::size_t i = 0; i < p.size(); ++i) {
        for (std::size_t j = 0; j < factor.size(); ++j) {
          product[i + j] += p[i] * factor[j];
        }
      }
      p = product;
    };
    times({1, Rational(-1, 2)});
    times({1, 2});
    times({1, -1, 1});
    times({1, -1});
    times({1, 1});
    times({1, 1});
    return p;
  }());
  EXPECT_EQ(result.left, 1);
  EXPECT_EQ(result.right, 1);
  EXPECT_EQ(result.imaginary, 5);
  EXPECT_EQ(result.largest_imaginary_multiplicity, 2);
  EXPECT_EQ(result.verdict, Verdict::kUnstable);
  EXPECT_EQ(circle({1, 0, 0}).left, 2);  // two delays
  EXPECT_EQ(circle({1, 1}).verdict, Verdict::kMarginal);
  EXPECT_EQ(circle({1, 2, 1}).verdict, Verdict::kRepeatedImaginary);
}

/// A free mass, samples T apart, u = -k1 x - k2 v: stable if and only if k1 > 0, k2 < 2 / T and
/// k1 T < 2 k2.
TEST(UnitCircle, KnowsTheBoundaryOfTheSampledMassToTheLastDigit) {
  const double up = std::numeric_limits<double>::infinity();
  const auto verdict = [](double k1, double k2, double period) {
    const Rational t(period), x = Rational(k1) * t * t / 2, v = Rational(k2) * t;
    return circle({1, x + v - 2, 1 + x - v}).verdict;
  };
  for (const auto& [k2, period] : {std::pair{1.0, 0.25}, {0.3, 0.1}, {7.7, 0.125}}) {
    const double k1 = 2.0 * k2 / period;
    const bool whole = Rational(k1) * Rational(period) == 2 * Rational(k2);
    if (whole) {
      EXPECT_EQ(verdict(k1, k2, period), Verdict::kMarginal);
    }
    EXPECT_EQ(verdict(std::nextafter(k1, 0.0), k2, period), Verdict::kAsymptoticallyStable);
    EXPECT_EQ(verdict(std::nextafter(k1, up), k2, period), Verdict::kUnstable);
    const double stiffest = 2.0 / period;
    EXPECT_EQ(verdict(1e-3, std::nextafter(stiffest, 0.0), period), Verdict::kAsymptoticallyStable);
    EXPECT_EQ(verdict(1e-3, std::nextafter(stiffest, up), period), Verdict::kUnstable);
    EXPECT_EQ(verdict(std::numeric_limits<double>::denorm_min(), k2, period),
              Verdict::kAsymptoticallyStable);
    EXPECT_EQ(verdict(0.0, k2, period), Verdict::kMarginal);
    EXPECT_EQ(verdict(-std::numeric_limits<double>::denorm_min(), k2, period), Verdict::kUnstable);
  }
}

/// A free mass with all states measured, and a loop of it.
SampledStability heldMass(double k1, double k2, double period) {
  LoopPlant plant{MatrixXd::Zero(2, 2), MatrixXd::Zero(2, 1), MatrixXd::Identity(2, 2)};
  plant.a(0, 1) = plant.b(1, 0) = 1.0;
  MatrixXd gain(1, 2);
  gain << k1, k2;
  return sampledStability(sampledLoop(plant, {stateFeedback(gain, 1.0 / period, 0.0)}));
}

TEST(SampledStability, IsWhatTheEquationsOfTheMassSay) {
  EXPECT_EQ(heldMass(8.0 * (1.0 - 1e-12), 1.0, 0.25).verdict, Verdict::kAsymptoticallyStable);
  EXPECT_EQ(heldMass(8.0, 1.0, 0.25).verdict, Verdict::kMarginal);
  EXPECT_EQ(heldMass(8.0 * (1.0 + 1e-12), 1.0, 0.25).verdict, Verdict::kUnstable);
  // in equilibrium at any position
  EXPECT_EQ(heldMass(0.0, 1.0, 0.1).verdict, Verdict::kMarginal);
  EXPECT_EQ(heldMass(0.0, 0.0, 0.1).verdict, Verdict::kRepeatedImaginary);  // it drifts
}

TEST(SampledStability, TwoOfAKindOnTheCircleAreMarginal) {
  // Two uncoupled free masses, each with a damper: two roots at 1 with independent eigenvectors.
  LoopPlant plant{MatrixXd::Zero(4, 4), MatrixXd::Zero(4, 2), MatrixXd::Identity(4, 4)};
  plant.a(0, 2) = plant.a(1, 3) = plant.b(2, 0) = plant.b(3, 1) = 1.0;
  MatrixXd gain = MatrixXd::Zero(2, 4);
  gain(0, 2) = gain(1, 3) = 1.0;
  const SampledStability braked =
      sampledStability(sampledLoop(plant, {stateFeedback(gain, 10.0, 0.0)}));
  EXPECT_EQ(braked.verdict, Verdict::kMarginal);
  EXPECT_EQ(braked.routh.imaginary, 2);
  // And at -1, each held as stiffly as it can be.
  gain(0, 0) = gain(1, 1) = 8.0;
  EXPECT_EQ(sampledStability(sampledLoop(plant, {stateFeedback(gain, 4.0, 0.0)})).verdict,
            Verdict::kMarginal);
}

/// A magnetic bearing of k_i = mu0 N^2 A i0 cos(alpha) / s0^2 and k_s = k_i i0 / s0, with PD
/// control of exactly the gain k_p = i0 / s0: the net stiffness is zero. Numbers: an example of
/// ROSS (petrobras/ross, MagneticBearingElement), whose sensitivity test accepts it.
SampledStability magneticBearing(double of_the_gain) {
  constexpr double kAir = 4e-7 * M_PI, kTurns = 200.0, kArea = 1e-4, kGap = 1e-3, kBias = 1.0;
  constexpr double kMass = 6.7;
  const double ki = kAir * kTurns * kTurns * kArea * kBias * std::cos(0.392) / (kGap * kGap);
  const double ks =
      kAir * kTurns * kTurns * kArea * kBias * kBias * std::cos(0.392) / (kGap * kGap * kGap);
  LoopPlant plant = unstableMass();
  plant.a(1, 0) = ks / kMass;
  plant.b(1, 0) = ki / kMass;
  LoopController pd = levitation(0.0, 0.0, 5e-5, 1.6);
  pd.law = sampledPd(of_the_gain * kBias / kGap, 5.0, 5e-5);
  pd.sensor_bandwidth = pd.actuator_bandwidth = 2000.0;
  return sampledStability(sampledLoop(plant, {pd}));
}

TEST(SampledStability, CallsABearingWithoutStiffnessMarginal) {
  const SampledStability bare = magneticBearing(1.0);
  EXPECT_EQ(bare.verdict, Verdict::kMarginal);
  EXPECT_TRUE(bare.exact);
  EXPECT_EQ(bare.routh.right, 0);
  EXPECT_EQ(bare.routh.imaginary, 1);
  EXPECT_NEAR(bare.spectral_radius, 1.0, 1e-12);
  EXPECT_EQ(magneticBearing(1.0 + 1e-6).verdict, Verdict::kAsymptoticallyStable);
  EXPECT_EQ(magneticBearing(1.0 - 1e-6).verdict, Verdict::kUnstable);
}

TEST(SampledStability, DoesNotDecideByRounding) {
  // An oscillator that nothing damps, seen by a controller that does nothing.
  LoopPlant plant = unstableMass();
  plant.a(1, 0) = -3.0;
  EXPECT_EQ(sampledStability(sampledLoop(plant, {levitation(0.0, 0.0, 0.1, 0.0)})).verdict,
            Verdict::kUncertain);
  plant.a(1, 1) = -1e-9;
  EXPECT_EQ(sampledStability(sampledLoop(plant, {levitation(0.0, 0.0, 0.1, 0.0)})).verdict,
            Verdict::kAsymptoticallyStable);
}

TEST(SampledStability, DoesNotDependOnUnits) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    RandomLoop loop = randomLoop(random);
    const SampledStability before = sampledStability(sampledLoop(loop.plant, loop.controllers));
    loop.plant.c *= 1e7;
    loop.plant.b *= 1e5;
    for (LoopController& c : loop.controllers) {
      c.law.b *= 1e-7;
      c.law.d *= 1e-12;
      c.law.c *= 1e-5;
    }
    const SampledStability after = sampledStability(sampledLoop(loop.plant, loop.controllers));
    EXPECT_EQ(before.verdict, after.verdict);
    EXPECT_NEAR(after.spectral_radius / before.spectral_radius, 1.0, 1e-9);
  }
}

TEST(SampledStability, JudgesManyStatesByEigenvalues) {
  const LoopPlant plant = unstableMass();
  const SampledStability late =
      sampledStability(sampledLoop(plant, {levitation(2.0, 1.0, 0.004, 25.0)}));
  EXPECT_FALSE(late.exact);
  EXPECT_EQ(late.routh.left, 28);
  EXPECT_EQ(late.verdict, Verdict::kAsymptoticallyStable);
  EXPECT_EQ(sampledStability(sampledLoop(plant, {levitation(2.0, 1.0, 0.03, 25.0)})).verdict,
            Verdict::kUnstable);
}

int outside(const MatrixXd& a) {
  const Eigen::EigenSolver<WideMatrix> solver(a.cast<Wide>(), false);
  int count = 0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const auto& z = solver.eigenvalues()[i];
    count += z.real() * z.real() + z.imag() * z.imag() > 1 ? 1 : 0;
  }
  return count;
}

/// 1,000 random loops; 10,000 with WHIRL_TWIN_EXTREMES=full.
TEST(SampledStability, CountsAsEigenvaluesInFiftyDigitsDo) {
  const char* length = std::getenv("WHIRL_TWIN_EXTREMES");
  const int loops = length != nullptr && std::string(length) == "full" ? 10000 : 1000;
  std::mt19937 random(20);
  int stable = 0, uncertain = 0, wrong = 0;
  for (int i = 0; i < loops; ++i) {
    const RandomLoop loop = randomLoop(random);
    const SampledLoop sampled = sampledLoop(loop.plant, loop.controllers);
    const SampledStability found = sampledStability(sampled);
    const int known = outside(balanced(sampled.transition));
    EXPECT_TRUE(found.exact);
    wrong += found.routh.right != known ? 1 : 0;
    uncertain += found.verdict == Verdict::kUncertain ? 1 : 0;
    stable += found.verdict == Verdict::kAsymptoticallyStable ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(uncertain, 0);
  EXPECT_GT(stable, loops / 5);
  EXPECT_LT(stable, loops * 4 / 5);
}

}  // namespace sampled_stability_test
}  // namespace whirl_twin
