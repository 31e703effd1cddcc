// The verdict on linearized systems: exact polynomial, Routh, eigenvalues and margins agree.

#include "analysis/stability.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "algebra/dense.h"
#include "analysis/characteristic_polynomial.h"
#include "analysis/equilibria.h"
#include "messages/input_error.h"
#include "models_under_test.h"

namespace whirl_twin {

namespace stability_test {

Linearization rotorAt(double speed, double damping, double internal_damping) {
  const auto rotor = dynamicsOf("jeffcott_rotor", {{"mass", 2.0},
                                                   {"stiffness", 180000.0},
                                                   {"damping", damping},
                                                   {"internal_damping", internal_damping}});
  return linearizationAtRest(*rotor, Eigen::VectorXd::Zero(2), speed);
}

TEST(CharacteristicPolynomial, isTheDeterminantAtRandomPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    const auto matrix = [&] {
      return Eigen::MatrixXd::NullaryExpr(3, 3, [&] { return uniform(random); }).eval();
    };
    Linearization l{matrix() + 3.0 * Eigen::MatrixXd::Identity(3, 3), matrix(), matrix(), matrix(),
                    matrix()};
    const auto p = characteristicPolynomial(l);
    ASSERT_EQ(p.size(), 7u);
    EXPECT_EQ(p.front(), 1);
    const double s = 1.5 * uniform(random);
    double value = 0.0;
    for (const Rational& c : p) {
      value = value * s + toDouble(c);
    }
    const Eigen::MatrixXd pencil =
        s * s * l.mass + s * (l.damping + l.gyroscopic) + l.stiffness + l.circulatory;
    EXPECT_NEAR(value, pencil.determinant() / l.mass.determinant(), 1.0e-11);
  }
}

TEST(CharacteristicPolynomial, refusesASingularMass) {
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(1, 1);
  EXPECT_THROW(characteristicPolynomial({zero, zero, zero, zero, zero}), InputError);
}

// Kimball: with c_e/c_i = 2 the rotor is stable below exactly 3 p = 900 rad/s.
TEST(Stability, internalDampingTurnsUnstableExactlyAtTheThreshold) {
  EXPECT_EQ(stability(rotorAt(899.0, 24.0, 12.0)).routh.verdict, Verdict::kAsymptoticallyStable);
  EXPECT_EQ(stability(rotorAt(900.0, 24.0, 12.0)).routh.verdict, Verdict::kMarginal);
  EXPECT_EQ(stability(rotorAt(901.0, 24.0, 12.0)).routh.verdict, Verdict::kUnstable);
}

// Reference case B01: forward and backward eigenvalues at 450 rad/s.
TEST(Stability, eigenvaluesOfTheInternallyDampedRotor) {
  const Stability s = stability(rotorAt(450.0, 24.0, 12.0));
  EXPECT_NEAR(s.decay_rate, 4.498480822919035, 1.0e-9);
  EXPECT_NEAR(s.log_decrement, 0.09424776886624463, 1.0e-9 * 0.0942);
  EXPECT_EQ(s.routh.left, 4);
}

// (s^2 + p^2)^2 has a repeated pair, but x and y do not feed each other: bounded.
TEST(Stability, anUndampedIsotropicRotorIsMarginalNotGrowing) {
  const Stability s = stability(rotorAt(100.0, 0.0, 0.0));
  EXPECT_EQ(s.routh.verdict, Verdict::kMarginal);
  EXPECT_EQ(s.routh.imaginary, 4);
  EXPECT_EQ(s.decay_rate, 0.0);
  EXPECT_EQ(s.damping_ratio, 0.0);
  EXPECT_EQ(s.log_decrement, 0.0);
}

// A free mass pushed once runs away like t: repeated zero without full eigenvectors.
TEST(Stability, aFreeMassIsRepeatedImaginary) {
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(1, 1);
  const Stability s = stability({Eigen::MatrixXd::Identity(1, 1), zero, zero, zero, zero});
  EXPECT_EQ(s.routh.verdict, Verdict::kRepeatedImaginary);
  EXPECT_EQ(s.routh.imaginary, 2);
}

TEST(Stability, modesOfADampedRotor) {
  const Stability s = stability(rotorAt(0.0, 60.0, 0.0));  // zeta = 60 / (2 * 2 * 300)
  ASSERT_EQ(s.natural_frequencies.size(), 2u);
  EXPECT_NEAR(s.natural_frequencies[0], 300.0, 1.0e-10);
  EXPECT_NEAR(s.damping_ratios[0], 0.05, 1.0e-13);
  EXPECT_NEAR(s.log_decrement, 0.31455270228880017, 1.0e-12);  // reference case A04
}

TEST(Stability, anOverdampedModeKeepsItsFrequencyAndRatio) {
  const Stability s = stability(rotorAt(0.0, 3600.0, 0.0));  // zeta = 3
  ASSERT_EQ(s.natural_frequencies.size(), 2u);
  EXPECT_NEAR(s.natural_frequencies[1], 300.0, 1.0e-9);
  EXPECT_NEAR(s.damping_ratios[1], 3.0, 1.0e-11);
  EXPECT_TRUE(std::isnan(s.log_decrement));
}

// Routh and the eigenvalues are independent: they agree wherever the real part differs from zero by
// more than rounding.
TEST(Stability, routhAndEigenvaluesAgreeOnRandomSystems) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int unstable = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto matrix = [&] {
      return Eigen::MatrixXd::NullaryExpr(2, 2, [&] { return uniform(random); }).eval();
    };
    const Eigen::MatrixXd m = matrix();
    const Eigen::MatrixXd g = matrix();
    const Eigen::MatrixXd c = matrix();
    const Eigen::MatrixXd k = matrix();
    const Linearization l{
        m * m.transpose() + Eigen::MatrixXd::Identity(2, 2), c * c.transpose(), g - g.transpose(),
        k * k.transpose() + 0.2 * Eigen::MatrixXd::Identity(2, 2), 0.4 * (k - k.transpose())};
    const Stability s = stability(l);
    int right = 0;
    for (const auto& root : s.eigenvalues) {
      right += root.real() > 0.0 ? 1 : 0;
      ASSERT_GT(std::fabs(root.real()), 1.0e-12);
    }
    EXPECT_EQ(s.routh.right, right);
    EXPECT_EQ(s.decay_rate<0.0, right> 0);
    unstable += right > 0 ? 1 : 0;
  }
  EXPECT_GT(unstable, 30);  // both verdicts occur
  EXPECT_LT(unstable, 270);
}

// Unstable above 300 (1 + 20/20) = 600 rad/s: whirl at 300 rad/s, a pair.
TEST(RightByEigenvalues, isToldWhereNothingExplainsADifference) {
  const Linearization unstable = rotorAt(700.0, 20.0, 20.0);
  const auto roots = eigenvalues(unstable);
  EXPECT_EQ(rightByEigenvalues(unstable, 0, roots, 2), 2);
  EXPECT_EQ(rightByEigenvalues(unstable, 0, roots, 0), 2) << "a test that counted none is wrong";
  const Linearization stable = rotorAt(500.0, 20.0, 20.0);
  EXPECT_EQ(rightByEigenvalues(stable, 0, eigenvalues(stable), 2), 0) << "and one that counts two";
}

TEST(RightByEigenvalues, isRouthsWhereRoundingLeavesItOpen) {
  // Within one to a thousand ulps of the threshold the eigenvalues cannot decide.
  for (const double ulps : {-1000.0, -10.0, -1.0, 0.0, 1.0, 10.0, 1000.0}) {
    const Linearization near = rotorAt(600.0 * (1.0 + ulps * 2.2e-16), 20.0, 20.0);
    const auto roots = eigenvalues(near);
    EXPECT_EQ(rightByEigenvalues(near, 0, roots, 0), 0) << ulps;
    EXPECT_EQ(rightByEigenvalues(near, 0, roots, 2), 2) << ulps;
    const Stability s = stability(near);
    EXPECT_EQ(s.right_by_eigenvalues, s.routh.right) << ulps;
  }
  // Undamped: all on the axis, and rounding scatters them to both sides.
  const Stability undamped = stability(rotorAt(700.0, 0.0, 0.0));
  EXPECT_EQ(undamped.right_by_eigenvalues, undamped.routh.right);
}

// Four equal roots at -1e-3 p, which rounding spreads by its fourth root and over the axis: chains
// of oscillators that one-sided springs make defective.
TEST(RightByEigenvalues, isRouthsOfRepeatedRootsThatRoundingSpreads) {
  for (const double damping : {1.0e-3, 1.0e-5, -1.0e-5, -1.0e-3}) {
    const Eigen::Index n = 4;
    Linearization chain;
    chain.mass = Eigen::MatrixXd::Identity(n, n);
    chain.damping = 2.0 * damping * Eigen::MatrixXd::Identity(n, n);
    chain.gyroscopic = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd by_q = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      by_q(i, i + 1) = 1.0;
    }
    chain.stiffness = 0.5 * (by_q + by_q.transpose());
    chain.circulatory = 0.5 * (by_q - by_q.transpose());
    const Stability s = stability(chain);
    EXPECT_EQ(s.routh.right, damping > 0.0 ? 0 : 8) << damping;
    EXPECT_EQ(s.right_by_eigenvalues, s.routh.right) << damping;
  }
}

}  // namespace stability_test

}  // namespace whirl_twin
