// Decay rates from ambient vibration: a rotor with known damping under random excitation.
#include "signal/decay_audit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "known_motion.h"
#include "signal/subspace_identification.h"

namespace whirl_twin {
namespace decay_audit_test {

TEST(SubspaceIdentification, FindsTheModesOfExactCovariances) {
  const Complex forward(-0.8, 100.0), backward(-3.0, -90.0);
  const double spacing = 0.01;
  std::vector<Complex> c;
  for (int k = 1; k <= 23; ++k) {
    c.push_back(4.0 * std::exp(forward * (k * spacing)) + std::exp(backward * (k * spacing)));
  }
  const auto modes = identifyModes(c, spacing, 4);
  ASSERT_GE(modes.size(), 2u);
  EXPECT_NEAR(modes[0].frequency, 100.0, 1e-8);
  EXPECT_NEAR(modes[0].decay_rate, 0.8, 1e-8);
  EXPECT_NEAR(modes[0].power, 4.0, 1e-7);
  EXPECT_NEAR(modes[1].frequency, -90.0, 1e-8);
  EXPECT_NEAR(modes[1].decay_rate, 3.0, 1e-8);
}

TEST(SubspaceIdentification, SaysGrowthAsADecayBelowZero) {
  std::vector<Complex> c;
  for (int k = 1; k <= 15; ++k) {
    c.push_back(std::exp(Complex(0.5, 60.0) * (0.02 * k)));
  }
  const auto modes = identifyModes(c, 0.02, 4);
  ASSERT_EQ(modes.size(), 1u);  // the others would be rounding
  EXPECT_NEAR(modes[0].decay_rate, -0.5, 1e-9);
}

/// A rotor z'' + (c + ci) z' + (w^2 - i ci W) z = noise, with a first order and noisy probes.
/// Stepped by the exact exponentials of its two modes.
class NoisyRotor {
 public:
  NoisyRotor(double external, double internal, double speed, double probe_noise, unsigned seed)
      : speed_(speed), probe_noise_(probe_noise), random_(seed) {
    const Complex c(external + internal, 0.0), k(1.0e4, -internal * speed);
    const Complex root = std::sqrt(c * c - 4.0 * k);
    poles_[0] = 0.5 * (-c + root);
    poles_[1] = 0.5 * (-c - root);
    if (poles_[0].imag() < 0.0) {
      std::swap(poles_[0], poles_[1]);
    }
  }

  double decayRate() const { return -poles_[0].real(); }

  OrbitSample next() {
    const double t = static_cast<double>(index_) * kStep;
    const double angle = speed_ * t;
    for (int m = 0; m < 2; ++m) {
      modes_[m] = std::exp(poles_[m] * kStep) * modes_[m] + noise() * 1e-5;
    }
    const Complex z = modes_[0] + modes_[1] + std::polar(5e-5, angle - 0.3) + Complex(0.0, -1e-4) +
                      probe_noise_ * noise();
    const double turns = std::floor(angle / (2.0 * kPi));
    return {index_++, t,       static_cast<std::int64_t>(turns), angle - 2.0 * kPi * turns, speed_,
            z.real(), z.imag()};
  }

 private:
  // One after the other: the order of two arguments is the compiler's.
  Complex noise() {
    const double imaginary = normal_(random_);
    return {normal_(random_), imaginary};
  }

  static constexpr double kStep = 1.0e-3;
  double speed_, probe_noise_;
  Complex poles_[2], modes_[2];
  std::int64_t index_ = 0;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

struct Audits {
  int reported = 0, inside = 0;
  double mean = 0.0, error = 0.0, said = 0.0;  // [1/s]
};

/// Twenty records of 40 s.
Audits audited(double external, double internal, double probe_noise) {
  Audits a;
  for (unsigned seed = 0; seed < 20; ++seed) {
    NoisyRotor rotor(external, internal, 120.0, probe_noise, seed);
    DecayAudit audit(40.0);
    for (int i = 0; i < 42500; ++i) {
      if (const auto decay = audit.take(rotor.next())) {
        const double off = decay->decay_rate - rotor.decayRate();
        ++a.reported;
        a.inside += std::fabs(off) < 3.0 * decay->deviation ? 1 : 0;
        a.mean += decay->decay_rate;
        a.said += decay->deviation;
        a.error += off * off;
        EXPECT_NEAR(std::fabs(decay->frequency), 100.0, 2.0);
      }
    }
  }
  a.mean /= a.reported;
  a.said /= a.reported;
  a.error = std::sqrt(a.error / a.reported);
  return a;
}

TEST(DecayAudit, FindsTheDecayOfANoisyRotorWithinItsInterval) {
  const double truth = NoisyRotor(4.0, 2.0, 120.0, 0.0, 0).decayRate();
  const Audits a = audited(4.0, 2.0, 1.0e-5);
  EXPECT_EQ(a.reported, 20);
  EXPECT_GE(a.inside, 19);
  EXPECT_NEAR(a.mean, truth, 0.25 * truth);
  // The limit of theory is sqrt(s/T).
  EXPECT_LT(a.error, 2.0 * std::sqrt(truth / 40.0));
  EXPECT_GT(a.said, 0.7 * a.error);
  EXPECT_LT(a.said, 2.0 * a.error);
}

// Near the threshold a fit of the samples themselves is off by tens with such probes
// (autoregression: 47 for 0.8), on the unsafe side.
TEST(DecayAudit, IsNotDeceivedByNoisyProbesNearTheThreshold) {
  const double truth = NoisyRotor(4.0, 3.2, 120.0, 0.0, 0).decayRate();
  EXPECT_LT(truth, 1.7);
  const Audits a = audited(4.0, 3.2, 4.0e-5);
  EXPECT_EQ(a.reported, 20);
  EXPECT_GE(a.inside, 19);
  EXPECT_NEAR(a.mean, truth, 0.3 * truth);
}

TEST(DecayAudit, SaysNothingOfASteadyFirstOrderOrOfARunUp) {
  for (const double acceleration : {0.0, 2.0}) {
    KnownMotion motion;
    motion.speed = 120.0;
    motion.acceleration = acceleration;
    motion.noise = acceleration > 0.0 ? 1e-6 : 0.0;
    motion.z = [](double, double angle, double) {
      return std::polar(5e-5, angle) + 1e-5 * std::polar(1.0, 2.0 * angle) + Complex(0.0, -1e-3);
    };
    DecayAudit audit(20.0);
    for (std::int64_t i = 0; i < 25000; ++i) {
      EXPECT_FALSE(audit.take(motion.sample(i))) << i;
    }
  }
}

TEST(DecayAudit, SeesGrowth) {
  KnownMotion motion;
  motion.speed = 250.0;
  motion.z = [](double t, double angle, double) {
    return std::polar(1e-5, angle) + std::polar(1e-6 * std::exp(0.2 * t), 100.0 * t);
  };
  DecayAudit audit(10.0);
  std::optional<AuditedDecay> last;
  for (std::int64_t i = 0; i < 12000; ++i) {
    if (const auto decay = audit.take(motion.sample(i))) {
      last = decay;
    }
  }
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->decay_rate, -0.2, 1e-3);
  EXPECT_NEAR(last->frequency, 100.0, 1e-2);
}

}  // namespace decay_audit_test
}  // namespace whirl_twin
