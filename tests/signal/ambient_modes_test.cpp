// Modes of a rotor with known modes under random excitation: measured at two stations, with a first
// and a second order, gaps and noisy probes.
#include "signal/ambient_modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "known_motion.h"
#include "signal/subspace_identification.h"

namespace whirl_twin {
namespace ambient_modes_test {

struct KnownMode {
  Complex pole;  // [1/s]
  std::vector<Complex> shape;
  double size;  // [m], standard deviation of either part
};

/// Stepped by the exact exponentials of its modes.
class NoisyShaft {
 public:
  NoisyShaft(std::vector<KnownMode> modes, double step, double speed, double probe_noise,
             unsigned seed)
      : modes_(std::move(modes)),
        states_(modes_.size()),
        step_(step),
        speed_(speed),
        probe_noise_(probe_noise),
        random_(seed) {
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      states_[m] = modes_[m].size * noise();
    }
  }

  StationSample next() {
    const double t = static_cast<double>(index_) * step_;
    const double angle = speed_ * t;
    StationSample sample;
    sample.index = index_++;
    sample.time = t;
    sample.turns = static_cast<std::int64_t>(std::floor(angle / (2.0 * kPi)));
    sample.remainder = angle - 2.0 * kPi * static_cast<double>(sample.turns);
    sample.speed = speed_;
    const auto stations = static_cast<Eigen::Index>(modes_.front().shape.size());
    sample.z = Eigen::VectorXcd::Zero(stations);
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      const KnownMode& mode = modes_[m];
      const Complex turned = std::exp(mode.pole * step_);
      states_[m] = turned * states_[m] + mode.size * std::sqrt(1.0 - std::norm(turned)) * noise();
      for (Eigen::Index s = 0; s < stations; ++s) {
        sample.z[s] += mode.shape[static_cast<std::size_t>(s)] * states_[m];
      }
    }
    for (Eigen::Index s = 0; s < stations; ++s) {  // unbalance, run-out, sag
      sample.z[s] += std::polar(first_order, angle - 0.3) + std::polar(1e-5, -angle) +
                     std::polar(4e-6, 2.0 * angle) + Complex(0.0, -1e-4) + probe_noise_ * noise();
    }
    return sample;
  }

  double first_order = 5e-5;  // [m]

 private:
  Complex noise() { return {normal_(random_), normal_(random_)}; }

  std::vector<KnownMode> modes_;
  std::vector<Complex> states_;
  double step_, speed_, probe_noise_;
  std::int64_t index_ = 0;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

std::optional<AmbientRecord> recorded(NoisyShaft& shaft, Eigen::Index stations, double step,
                                      double duration, double limit) {
  AmbientModes modes(stations, step, 130.0, limit);
  for (std::int64_t i = 0; static_cast<double>(i) * step < duration; ++i) {
    modes.take(shaft.next());
  }
  return modes.record();
}

const std::vector<KnownMode> kFourModes{{{-1.5, 100.0}, {1.0, 0.6}, 1e-5},
                                        {{-2.5, -94.0}, {1.0, 0.5}, 1e-5},
                                        {{-6.0, 290.0}, {0.5, -1.0}, 4e-6},
                                        {{-5.0, -240.0}, {0.6, Complex(-1.0, 0.1)}, 4e-6}};

TEST(AmbientModes, AreFoundOfBothSensesWithTheirShapes) {
  NoisyShaft shaft(kFourModes, 1e-3, 130.0, 3e-6, 1);
  const auto record = recorded(shaft, 2, 1e-3, 120.0, 350.0);
  ASSERT_TRUE(record);
  EXPECT_GT(record->duration, 110.0);
  EXPECT_NEAR(record->vibration, std::hypot(1.35e-5, 4.5e-6), 3e-6);
  EXPECT_NEAR(record->orders, 5.1e-5 / std::sqrt(2.0), 2e-6);
  ASSERT_EQ(record->modes.size(), 4u);
  const std::size_t by_size[] = {1, 0, 3, 2};
  for (std::size_t i = 0; i < 4; ++i) {
    const KnownMode& truth = kFourModes[by_size[i]];
    const AmbientMode& mode = record->modes[i];
    EXPECT_NEAR(mode.frequency, truth.pole.imag(), 3.0 * mode.frequency_deviation);
    EXPECT_NEAR(mode.decay_rate, -truth.pole.real(), 3.0 * mode.decay_deviation);
    EXPECT_LT(mode.decay_deviation, 0.5 * mode.decay_rate);
    EXPECT_EQ(mode.order, 0);
    const Complex ratio = truth.shape[1] / truth.shape[0];
    EXPECT_LT(std::abs(mode.shape[1] / mode.shape[0] - ratio), 0.1 * std::abs(ratio)) << i;
    EXPECT_LT(mode.shape_deviation.maxCoeff(), 0.2);
  }
}

// 95 of 100 records of one and a half minutes should hold the truth in their intervals.
TEST(AmbientModes, IntervalsHoldWhatTheySay) {
  const std::vector<KnownMode> modes{{{-1.2, 100.0}, {1.0}, 1e-5}, {{-2.0, -90.0}, {1.0}, 7e-6}};
  int identified = 0, inside_frequency = 0, inside_decay = 0;
  double bias = 0.0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    NoisyShaft shaft(modes, 4e-3, 130.0, 3e-6, seed);
    const auto record = recorded(shaft, 1, 4e-3, 90.0, 150.0);
    ASSERT_TRUE(record);
    for (const AmbientMode& mode : record->modes) {
      const KnownMode& truth = modes[mode.frequency > 0.0 ? 0 : 1];
      ++identified;
      inside_frequency += std::fabs(mode.frequency - truth.pole.imag()) <
                          record->interval * mode.frequency_deviation;
      inside_decay +=
          std::fabs(mode.decay_rate + truth.pole.real()) < record->interval * mode.decay_deviation;
      bias += mode.decay_rate / -truth.pole.real() - 1.0;
    }
  }
  EXPECT_GE(identified, 195);
  EXPECT_LE(identified, 204);  // nothing that is not there
  EXPECT_GE(inside_frequency, 0.91 * identified);
  EXPECT_GE(inside_decay, 0.91 * identified);
  EXPECT_LT(std::fabs(bias / identified), 0.08);
  EXPECT_LE(inside_frequency + inside_decay, 1.99 * identified);  // and are not trivially wide
}

TEST(AmbientModes, AreSaidToStandAtAnOrderThatCannotBeToldFromThem) {
  const std::vector<KnownMode> modes{{{-1.5, 130.5}, {1.0}, 1e-5}, {{-1.5, -100.0}, {1.0}, 1e-5}};
  NoisyShaft shaft(modes, 4e-3, 130.0, 1e-6, 3);
  const auto record = recorded(shaft, 1, 4e-3, 60.0, 200.0);
  ASSERT_TRUE(record);
  int marked = 0;
  for (const AmbientMode& mode : record->modes) {
    marked += mode.order;
    EXPECT_EQ(mode.order, mode.frequency > 0.0 ? 1 : 0) << mode.frequency;
  }
  EXPECT_GE(marked, 1);
}

TEST(AmbientModes, DoNotComeFromShortRecordsNorFromNothingButOrdersAndNoise) {
  NoisyShaft shaft(kFourModes, 1e-3, 130.0, 1e-6, 1);
  EXPECT_FALSE(recorded(shaft, 2, 1e-3, 0.9, 350.0));
  NoisyShaft quiet({{{-1.0, 100.0}, {1.0}, 0.0}}, 1e-3, 130.0, 3e-6, 5);
  const auto record = recorded(quiet, 1, 1e-3, 60.0, 350.0);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->modes.size(), 0u);
}

TEST(AmbientModes, GoOnAfterAGap) {
  NoisyShaft shaft(kFourModes, 1e-3, 130.0, 1e-6, 9);
  AmbientModes modes(2, 1e-3, 130.0, 350.0);
  for (int i = 0; i < 120000; ++i) {
    StationSample sample = shaft.next();
    if (i % 20000 > 400) {
      if (i % 20000 == 9000) {
        sample.z[1] = std::nan("");
      }
      modes.take(sample);
    }
  }
  const auto record = modes.record();
  ASSERT_TRUE(record);
  EXPECT_EQ(record->modes.size(), 4u);
  EXPECT_LT(record->duration, 117.0);
}

TEST(SubspaceIdentification, TellsTwoModesOfOneFrequencyByTheirShapes) {
  const Complex pole(-0.8, 100.0);
  const Eigen::Vector2cd up(1.0, 1.0), across(1.0, -0.8);
  std::vector<Eigen::MatrixXcd> covariance;
  for (int k = 3; k <= 25; ++k) {
    covariance.emplace_back(std::exp(pole * (0.01 * k)) * up * up.adjoint() +
                            std::exp(Complex(-2.0, 100.0) * (0.01 * k)) * across *
                                across.adjoint());
  }
  const auto modes = SubspaceIdentification(covariance, 0.01, 3).modes(6);
  ASSERT_GE(modes.size(), 2u);
  EXPECT_NEAR(modes[0].decay_rate, 0.8, 1e-7);
  EXPECT_NEAR(modes[0].power, 2.0, 1e-6);
  EXPECT_LT((modes[0].shape - up / up[0]).norm(), 1e-6);
  EXPECT_NEAR(modes[1].decay_rate, 2.0, 1e-7);
  EXPECT_LT((modes[1].shape - across).norm(), 1e-6);
}

}  // namespace ambient_modes_test
}  // namespace whirl_twin
