#include "analysis/loop_margins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/sampled_margins.h"
#include "loops_under_test.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace loop_margins_test {

using Complex = std::complex<double>;
constexpr double kPi = 3.14159265358979323846;
const Complex kJ{0.0, 1.0};

/// x'' = x + u, u = -(kp x + d x') after a delay, in continuous time; behind a pole of the
/// amplifier with this time constant.
LoopResponse levitated(double kp, double d, double delay, double amplifier = 0.0) {
  LoopResponse response;
  response.open_loop = [=](double w) {
    return (kp + d * kJ * w) / (-w * w - 1.0) * std::exp(-kJ * w * delay) /
           (1.0 + amplifier * kJ * w);
  };
  response.poles = {1.0, -1.0, -d / 2.0 + kJ * std::sqrt(kp - 1.0)};
  if (amplifier > 0.0) {
    response.poles.emplace_back(-1.0 / amplifier);
  }
  return response;
}

struct Levitated {
  double kp, d, peak[5], delay_margin, phase_margin, crossover;
};

TEST(LoopMargins, AreThoseOfTheLevitatedMass) {
  const Levitated known[] = {
      {2.0,
       std::sqrt(2.0),
       {1.41421, 1.52588, 1.66603, 2.07981, 2.83915},
       0.5694731892,
       42.9414,
       1.3160740},
      {1.5, 1.0, {2.23607, 2.36426, 2.53032, 3.02479, 3.90274}, 0.6063700068, 29.5769, 0.8513195}};
  const double delays[] = {0.0, 0.05, 0.1, 0.2, 0.3};
  for (const Levitated& k : known) {
    for (int i = 0; i < 5; ++i) {
      EXPECT_NEAR(loopMargins(levitated(k.kp, k.d, delays[i])).sensitivity_peak, k.peak[i], 6e-6);
    }
    const LoopMargins bare = loopMargins(levitated(k.kp, k.d, 0.0));
    EXPECT_NEAR(bare.delay_margin, k.delay_margin, 1e-10);
    EXPECT_NEAR(bare.phase_margin * 180.0 / kPi, k.phase_margin, 6e-5);
    EXPECT_NEAR(bare.phase_crossover, k.crossover, 6e-8);
    EXPECT_NEAR(bare.gain_reduction, 1.0 / k.kp, 1e-15);
    EXPECT_EQ(bare.gain_margin, std::numeric_limits<double>::infinity());
    // An added delay reduces the delay margin by the same amount.
    EXPECT_NEAR(loopMargins(levitated(k.kp, k.d, 0.2)).delay_margin, k.delay_margin - 0.2, 1e-10);
  }
}

TEST(LoopMargins, ANetStiffnessOfOneHasThePeakThatItsDampingLeaves) {
  // k_P = 2: max |S| = 2 / d at w = 1 while d <= sqrt(2).
  for (const double d : {1e-4, 0.01, 0.5, 0.667, 1.0, 1.4}) {
    const LoopMargins m = loopMargins(levitated(2.0, d, 0.0));
    EXPECT_NEAR(m.sensitivity_peak * d, 2.0, 1e-12) << d;
    EXPECT_NEAR(m.peak_frequency, 1.0, 1e-7);
    EXPECT_EQ(m.zone, d > 2.0 / 3.0 ? SensitivityZone::kA
                      : d > 0.5     ? SensitivityZone::kB
                      : d >= 0.4    ? SensitivityZone::kC
                                    : SensitivityZone::kD);
  }
}

TEST(LoopMargins, ZonesAreThoseOfTheStandard) {
  EXPECT_STREQ(name(zoneOf(2.99)), "A");
  EXPECT_STREQ(name(zoneOf(3.0)), "B");
  EXPECT_STREQ(name(zoneOf(4.0)), "C");
  EXPECT_STREQ(name(zoneOf(5.01)), "D");
  EXPECT_STREQ(name(zoneOf(std::numeric_limits<double>::infinity())), "unbounded");
}

/// Tilt of a rotor that turns, s^2 - j g W s - 1 + (kP + d s) e^(-theta s), loses its stability at
/// a speed W that is known for each delay.
TEST(LoopMargins, ATurningRotorLosesItsNutation) {
  constexpr double kP = 2.0, kGyroscopic = 1.2;
  const double d = std::sqrt(2.0);
  for (const auto& [delay, speed] :
       {std::pair{0.05, 24.254970788536}, {0.1, 11.166108253016}, {0.2, 4.613163688883}}) {
    const double turning = kGyroscopic * speed;
    double margin = std::numeric_limits<double>::infinity();
    for (const double sense : {1.0, -1.0}) {
      LoopResponse whirl;
      whirl.open_loop = [=](double w) {
        const Complex s = sense * kJ * w;
        const Complex loop = (kP + d * s) / (s * s - kJ * turning * s - 1.0);
        return sense > 0.0 ? loop : std::conj(loop);
      };
      whirl.poles = {kJ * turning, -1.0, kJ / turning};
      margin = std::fmin(margin, loopMargins(whirl).delay_margin);
    }
    EXPECT_NEAR(margin, delay, 1e-12);
  }
}

TEST(LoopMargins, BodesIntegralIsThatOfTheUnstablePole) {
  // Of the bare mass L falls as d / w: pi - pi d / 2.
  EXPECT_NEAR(logSensitivityIntegral(levitated(2.0, std::sqrt(2.0), 0.0)),
              kPi - kPi * std::sqrt(2.0) / 2.0, 1e-11);
  EXPECT_NEAR(logSensitivityIntegral(levitated(2.0, std::sqrt(2.0), 0.0, 0.1)), kPi, 1e-11);
}

TEST(LoopMargins, NoLoopAmplifiesNothing) {
  LoopResponse impossible;
  impossible.open_loop = [](double) { return Complex(1.0, 0.0); };
  impossible.poles = {-1.0};
  EXPECT_THROW(loopMargins(impossible), RunFailure);
}

SampledMargins marginsOf(const LoopController& controller) {
  const LoopPlant plant = unstableMass();
  const Verdict verdict = sampledStability(sampledLoop(plant, {controller})).verdict;
  return sampledMargins(plant, {controller}, 0, verdict).front();
}

TEST(SampledMargins, HaveBodesIntegral) {
  for (const double late : {0.0, 0.5, 1.0, 1.7}) {
    EXPECT_LT(marginsOf(levitation(2.0, std::sqrt(2.0), 0.1, late)).bode_error, 1e-11) << late;
  }
  LoopController filtered = levitation(2.0, std::sqrt(2.0), 0.1, 0.3);
  filtered.sensor_bandwidth = filtered.actuator_bandwidth = 5.0;
  EXPECT_LT(marginsOf(filtered).bode_error, 1e-11);
  LoopController amplified = levitation(2.0, std::sqrt(2.0), 0.1, 0.0);
  amplified.actuator_bandwidth = 1.0 / (0.1 * 2.0 * kPi);  // a lag of 0.1 s
  EXPECT_LT(marginsOf(amplified).bode_error, 1e-12);
}

TEST(SampledMargins, OfFastSamplesAreThoseOfContinuousTime) {
  // Held outputs are late by half a sample, and so are backward differences.
  constexpr double kPeriod = 0.01, kSamples = 9.0;
  const double kp = 2.0, d = std::sqrt(2.0);
  LoopResponse continuous = levitated(kp, d, 0.0);
  continuous.open_loop = [=](double w) {
    const Complex s = kJ * w;
    return (kp + d * s * std::exp(-0.5 * kPeriod * s)) / (s * s - 1.0) *
           std::exp(-(kSamples + 0.5) * kPeriod * s);
  };
  const LoopMargins limit = loopMargins(continuous);
  const SampledMargins fast = marginsOf(levitation(kp, d, kPeriod, kSamples));
  EXPECT_NEAR(fast.sensitivity_peak, limit.sensitivity_peak, 2e-4);
  EXPECT_NEAR(fast.peak_frequency, limit.peak_frequency, 2e-4);
  EXPECT_NEAR(fast.gain_margin, limit.gain_margin, 0.03);
  EXPECT_NEAR(fast.gain_reduction, limit.gain_reduction, 1e-12);
  EXPECT_NEAR(fast.delay_margin, limit.delay_margin, 2e-4);
  EXPECT_NEAR(fast.phase_margin, limit.phase_margin, 2e-4);
}

TEST(SampledMargins, AreWhereTheLoopLosesItsStability) {
  const LoopPlant plant = unstableMass();
  const auto verdict = [&](const LoopController& c) {
    return sampledStability(sampledLoop(plant, {c})).verdict;
  };
  const LoopController controller = levitation(2.0, 1.0, 0.1, 0.4);
  const SampledMargins m = marginsOf(controller);
  for (const double gain : {m.gain_margin, m.gain_reduction}) {
    LoopController changed = controller;
    const double towards = gain > 1.0 ? 1.0 - 1e-9 : 1.0 + 1e-9;
    changed.law.c *= gain * towards;
    changed.law.d *= gain * towards;
    EXPECT_EQ(verdict(changed), Verdict::kAsymptoticallyStable) << gain;
    changed.law.c *= (2.0 - towards) / towards;
    changed.law.d *= (2.0 - towards) / towards;
    EXPECT_EQ(verdict(changed), Verdict::kUnstable) << gain;
  }
  LoopController late = controller;
  late.delay = controller.delay + 0.95 * m.delay_margin;
  EXPECT_EQ(verdict(late), Verdict::kAsymptoticallyStable);
  late.delay = controller.delay + 1.05 * m.delay_margin;
  EXPECT_EQ(verdict(late), Verdict::kUnstable);
}

/// In addition to the mass a weakly damped flexible mode of high frequency, which the controller
/// excites a little.
LoopPlant withFlexibleMode(double driven) {
  LoopPlant plant{Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1),
                  Eigen::MatrixXd::Zero(1, 4)};
  plant.a.topLeftCorner(2, 2) = unstableMass().a;
  plant.a(2, 3) = 1.0;
  plant.a(3, 2) = -17.0 * 17.0;
  plant.a(3, 3) = -2e-7;
  plant.b << 0, 1, 0, driven;
  plant.c << 1, 0, 1e-3, 0;
  return plant;
}

TEST(SampledMargins, NoLightlyDampedPeakIsMissed) {
  const LoopController controller = levitation(2.0, 1.0, 0.02, 1.0);
  const auto stable = [&](double driven) {
    return sampledStability(sampledLoop(withFlexibleMode(driven), {controller})).verdict ==
           Verdict::kAsymptoticallyStable;
  };
  // Driven by nearly what takes its damping away.
  const double sense = stable(1e-2) ? -1.0 : 1.0;
  double driven = 1e-6 * sense;
  while (stable(1.02 * driven)) {
    driven *= 1.02;
    ASSERT_LT(std::fabs(driven), 1.0);
  }
  const LoopPlant plant = withFlexibleMode(driven);
  const SampledMargins m =
      sampledMargins(plant, {controller}, 0, Verdict::kAsymptoticallyStable).front();
  EXPECT_GT(m.sensitivity_peak, 20.0);
  EXPECT_NEAR(m.peak_frequency, 17.0, 1e-5);
  // With a frequency resolution finer than the width of the peak no value is higher.
  const LoopResponse response = sampledResponses(plant, {controller}, 0).front();
  for (int i = -10000; i <= 10000; ++i) {
    const double w = m.peak_frequency + 1e-10 * i;
    ASSERT_LE(1.0 / std::abs(1.0 + response.open_loop(w)), m.sensitivity_peak * (1.0 + 1e-9));
  }
  EXPECT_LT(m.bode_error, 1e-7);
}

TEST(SampledMargins, AnUnstableLoopHasNone) {
  const SampledMargins m = marginsOf(levitation(0.5, 1.0, 0.1, 0.0));
  EXPECT_EQ(m.sensitivity_peak, std::numeric_limits<double>::infinity());
  EXPECT_EQ(m.zone, SensitivityZone::kUnbounded);
  EXPECT_EQ(m.phase_margin, 0.0);
}

TEST(SampledMargins, AreSeenAxisByAxisWithAllOtherLoopsClosed) {
  // Two masses that have nothing to do with one another, under one controller of two axes.
  LoopPlant two{Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 2),
                Eigen::MatrixXd::Zero(2, 4)};
  two.a.topLeftCorner(2, 2) = two.a.bottomRightCorner(2, 2) = unstableMass().a;
  two.b(1, 0) = two.b(3, 1) = 1.0;
  two.c(0, 0) = two.c(1, 2) = 1.0;
  const LoopController x = levitation(2.0, 1.4, 0.1, 0.5);
  const LoopController y = levitation(1.5, 1.0, 0.1, 0.5);
  LoopController both = x;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(2, 2);
  both.law = {none, none, none, none};
  const DiscreteStateSpace* laws[] = {&x.law, &y.law};
  for (Eigen::Index i = 0; i < 2; ++i) {
    both.law.b(i, i) = laws[i]->b(0, 0);
    both.law.c(i, i) = laws[i]->c(0, 0);
    both.law.d(i, i) = laws[i]->d(0, 0);
  }
  both.measures = both.acts_on = {0, 1};
  const std::vector<SampledMargins> axes =
      sampledMargins(two, {both}, 0, Verdict::kAsymptoticallyStable);
  EXPECT_NEAR(axes[0].sensitivity_peak, marginsOf(x).sensitivity_peak, 1e-12);
  EXPECT_NEAR(axes[1].sensitivity_peak, marginsOf(y).sensitivity_peak, 1e-12);
  EXPECT_NEAR(axes[1].delay_margin, marginsOf(y).delay_margin, 1e-12);
  EXPECT_LT(axes[0].bode_error, 1e-11);
}

TEST(SampledMargins, ASlowLoopBesideItChangesNothingThatItDoesNotTouch) {
  LoopPlant two{Eigen::MatrixXd::Zero(3, 3), Eigen::MatrixXd::Zero(3, 2),
                Eigen::MatrixXd::Zero(2, 3)};
  two.a.topLeftCorner(2, 2) = unstableMass().a;
  two.a(2, 2) = -1.0;
  two.b(1, 0) = two.b(2, 1) = 1.0;
  two.c(0, 0) = two.c(1, 2) = 1.0;
  const LoopController fast = levitation(2.0, 1.4, 0.1, 0.5);
  LoopController slow = levitation(0.1, 0.0, 0.3, 0.0);
  slow.measures = slow.acts_on = {1};
  const std::vector<SampledMargins> seen =
      sampledMargins(two, {fast, slow}, 0, Verdict::kAsymptoticallyStable);
  EXPECT_NEAR(seen[0].sensitivity_peak, marginsOf(fast).sensitivity_peak, 1e-12);
  EXPECT_TRUE(std::isnan(seen[0].bode_error));
  EXPECT_LT(sampledMargins(two, {fast, slow}, 1, Verdict::kAsymptoticallyStable)[0].bode_error,
            1e-11);
}

}  // namespace loop_margins_test
}  // namespace whirl_twin
