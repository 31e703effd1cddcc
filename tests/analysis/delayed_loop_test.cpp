// Loops with long delays, and margins of all sensors at once: closed forms, dense eigenvalues of
// the same transition, and where the verdict changes.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <chrono>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "analysis/delayed_matrix.h"
#include "analysis/sampled_margins.h"
#include "analysis/sampled_stability.h"
#include "loops_under_test.h"

namespace whirl_twin {
namespace delayed_loop_test {

using Complex = std::complex<double>;
using Eigen::MatrixXd;

constexpr double kPeriod = 0.01;  // s

/// x' = u, u = -gain x, `late` samples late: z^(late + 1) - z^late + gain T = 0.
LoopPlant integrator() {
  return {MatrixXd::Zero(1, 1), MatrixXd::Ones(1, 1), MatrixXd::Ones(1, 1)};
}
LoopController proportional(double gain, int late) {
  LoopController controller =
      stateFeedback(MatrixXd::Constant(1, 1, gain), 1.0 / kPeriod, late * kPeriod);
  return controller;
}

/// The gain that it loses its stability at (S. Levin, R. May, Theor. Popul. Biol. 9 (1976) 178);
/// pi / (2 late T) for fast samples.
double largestGain(int late) {
  return 2.0 * std::sin(kPi / (2.0 * (2.0 * late + 1.0))) / kPeriod;
}

SampledStability stabilityOf(const LoopPlant& plant, const LoopController& controller) {
  return sampledStability(sampledLoop(plant, {controller}));
}

TEST(DelayedLoop, AnIntegratorIsStableUpToTheGainOfTheClosedForm) {
  for (const int late : {20, 100, 300, 1000}) {
    SCOPED_TRACE(late);
    const double most = largestGain(late);
    for (const double part : {0.01, 0.5, 0.999, 1.0 - 1e-6}) {
      EXPECT_EQ(stabilityOf(integrator(), proportional(part * most, late)).verdict,
                Verdict::kAsymptoticallyStable)
          << part;
    }
    const SampledStability beyond = stabilityOf(integrator(), proportional(1.001 * most, late));
    EXPECT_EQ(beyond.verdict, Verdict::kUnstable);
    EXPECT_EQ(beyond.routh.right, 2);
    EXPECT_NE(stabilityOf(integrator(), proportional(most, late)).verdict,
              Verdict::kAsymptoticallyStable);
  }
}

TEST(DelayedLoop, OfAThousandSamplesTakesSecondsAndHasTheMarginsOfTheClosedForm) {
  constexpr int kLate = 1000;
  const auto start = std::chrono::steady_clock::now();
  const double gain = 0.3 * largestGain(kLate);
  const LoopController controller = proportional(gain, kLate);
  const Verdict verdict = stabilityOf(integrator(), controller).verdict;
  const SampledMargins m = sampledMargins(integrator(), {controller}, 0, verdict).front();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_LT(taken.count(), 5.0);
  EXPECT_NEAR(m.gain_margin, 1.0 / 0.3, 1e-9);
  // |L| = gain T / |z - 1| = 1 at w: 2 sin(w T / 2) = gain T, its phase -pi / 2 + w T / 2 - w late
  // T.
  const double w = 2.0 / kPeriod * std::asin(0.5 * gain * kPeriod);
  const double phase = 0.5 * kPi + 0.5 * w * kPeriod - w * kLate * kPeriod;
  EXPECT_NEAR(m.phase_margin, phase - w * kPeriod, 1e-9);
  EXPECT_NEAR(m.delay_margin, m.phase_margin / w, 1e-9);
}

TEST(DelayedLoop, HasTheLeadingEigenvaluesOfItsTransition) {
  for (const double late : {90.0, 130.4}) {
    LoopController controller = levitation(2.0, std::sqrt(2.0), 0.002, late);
    controller.sensor_bandwidth = 40.0;
    const SampledLoop loop = sampledLoop(unstableMass(), {controller});
    ASSERT_TRUE(isMostlyDelays(DelayedMatrix(loop.transition)));
    const SampledStability found = sampledStability(loop);
    const Eigen::VectorXcd dense =
        Eigen::EigenSolver<MatrixXd>(loop.transition, false).eigenvalues();
    EXPECT_NEAR(found.spectral_radius, dense.cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_EQ(found.routh.right, (dense.array().abs() > 1.0).count());
    for (const Complex& z : dense) {
      if (std::abs(z) > 0.97) {
        double nearest = 1.0;
        for (const Complex& root : found.eigenvalues) {
          nearest = std::fmin(nearest, std::abs(root - z));
        }
        EXPECT_LT(nearest, 1e-9) << z;
      }
    }
  }
}

TEST(DelayedLoop, ResponsesAreThoseOfADenseSolution) {
  LoopController controller = levitation(2.0, std::sqrt(2.0), 0.002, 90.0);
  const SampledLoop loop = sampledLoop(unstableMass(), {controller});
  const LoopTap tap = loopTap(unstableMass(), {controller}, {{0, 0, false}});
  const LoopResponse response = sampledResponses(unstableMass(), {controller}, 0).front();
  const Eigen::Index n = loop.transition.rows();
  for (const double w : {0.1, 1.7, 30.0, 900.0}) {
    const Complex z = std::polar(1.0, w * loop.period);
    const Eigen::MatrixXcd shifted = z * MatrixXd::Identity(n, n) - loop.transition;
    const Complex sensitivity =
        (tap.output * shifted.partialPivLu().solve(tap.input.cast<Complex>()) + tap.direct)(0, 0);
    EXPECT_LT(std::abs(response.open_loop(w) - (1.0 / sensitivity - 1.0)), 1e-9) << w;
  }
}

// G = [[s - a^2, a (s + 1)], [-a (s + 1), s - a^2]] / (s^2 + a^2) under unit feedback, a = 10 (J.
// Doyle, G. Stein, IEEE Trans. Automatic Control 26 (1981) 4): alone each loop is 1 / s, which
// bears a delay of pi / 2 s. Together eigenvalues are (1 +- i a) / (s -+ i a), which are 1 in size
// where |w -+ a| = sqrt(1 + a^2).
TEST(SimultaneousMargins, OfASpinningBodyAreFarLessThanThoseOfEachAxis) {
  const double spin = 10.0;
  const double size = std::sqrt(1.0 + spin * spin);
  LoopMatrixResponse together;
  together.poles = {Complex(0.0, spin), -1.0};
  together.open_loop = [spin](double w) -> Eigen::MatrixXcd {
    const Complex s(0.0, w);
    Eigen::Matrix2cd g;
    g << s - spin * spin, spin * (s + 1.0), -spin * (s + 1.0), s - spin * spin;
    return g / (s * s + spin * spin);
  };
  EXPECT_NEAR(simultaneousMargins(together).delay_margin,
              (std::atan(spin) + 0.5 * kPi) / (spin + size), 1e-9);
  EXPECT_NEAR(simultaneousMargins(together).phase_margin, 0.5 * kPi - std::atan(spin), 1e-9);
}

TEST(SimultaneousMargins, AreWhereTheLoopWithAllDelayedLosesItsStability) {
  // Two masses, each pushed away, that also push each other aside.
  LoopPlant two{MatrixXd::Zero(4, 4), MatrixXd::Zero(4, 2), MatrixXd::Zero(2, 4)};
  two.a << 0, 1, 0, 0, 1, 0, 0.4, 0, 0, 0, 0, 1, -0.4, 0, 1, 0;
  two.b(1, 0) = two.b(3, 1) = 1.0;
  two.c(0, 0) = two.c(1, 2) = 1.0;
  std::vector<LoopController> both{levitation(2.0, 1.4, 0.02, 0.5),
                                   levitation(1.6, 1.1, 0.02, 2.0)};
  both[1].measures = both[1].acts_on = {1};
  const auto later = [&](double delay, double gain) {
    std::vector<LoopController> late = both;
    for (LoopController& controller : late) {
      controller.delay += delay;
      controller.law.c *= gain;
      controller.law.d *= gain;
    }
    return sampledStability(sampledLoop(two, late)).verdict;
  };
  const Verdict verdict = later(0.0, 1.0);
  ASSERT_EQ(verdict, Verdict::kAsymptoticallyStable);
  const LoopMargins at_once = sampledMarginsAtOnce(two, both, verdict);
  EXPECT_EQ(later(0.99 * at_once.delay_margin, 1.0), Verdict::kAsymptoticallyStable);
  EXPECT_EQ(later(1.01 * at_once.delay_margin, 1.0), Verdict::kUnstable);
  EXPECT_EQ(later(0.0, (1.0 - 1e-9) * at_once.gain_margin), Verdict::kAsymptoticallyStable);
  EXPECT_EQ(later(0.0, (1.0 + 1e-9) * at_once.gain_margin), Verdict::kUnstable);
  EXPECT_EQ(later(0.0, (1.0 + 1e-9) * at_once.gain_reduction), Verdict::kAsymptoticallyStable);
  EXPECT_EQ(later(0.0, (1.0 - 1e-9) * at_once.gain_reduction), Verdict::kUnstable);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(at_once.delay_margin, sampledMargins(two, both, i, verdict).front().delay_margin);
  }
}

TEST(SimultaneousMargins, OfOneOutputAreThoseAtTheInputOfThePlant) {
  // A free mass with both states measured.
  LoopPlant plant{MatrixXd::Zero(2, 2), MatrixXd::Zero(2, 1), MatrixXd::Identity(2, 2)};
  plant.a(0, 1) = plant.b(1, 0) = 1.0;
  const LoopController controller =
      stateFeedback((MatrixXd(1, 2) << 4.0, 3.0).finished(), 200.0, 0.004);
  const Verdict verdict = sampledStability(sampledLoop(plant, {controller})).verdict;
  ASSERT_EQ(verdict, Verdict::kAsymptoticallyStable);
  const LoopMargins at_once = sampledMarginsAtOnce(plant, {controller}, verdict);
  for (const SampledMargins& sensor : sampledMargins(plant, {controller}, 0, verdict)) {
    EXPECT_GT(sensor.delay_margin, at_once.delay_margin);
  }
  const SampledMargins input =
      sampledMargins(plant, {controller}, 0, verdict, LoopSide::kOutputs).front();
  EXPECT_NEAR(at_once.delay_margin, input.delay_margin, 1e-9);
  EXPECT_NEAR(at_once.gain_margin, input.gain_margin, 1e-9);
  EXPECT_LT(input.bode_error, 1e-6);
  LoopController late = controller;
  late.delay += 0.98 * at_once.delay_margin;
  EXPECT_EQ(stabilityOf(plant, late).verdict, Verdict::kAsymptoticallyStable);
  late.delay = controller.delay + 1.02 * at_once.delay_margin;
  EXPECT_EQ(stabilityOf(plant, late).verdict, Verdict::kUnstable);
}

}  // namespace delayed_loop_test
}  // namespace whirl_twin
