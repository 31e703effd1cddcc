// Receptance: reciprocity, the static limit, the closed form of one coordinate, resonance.
#include "analysis/frequency_response.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <complex>

#include "algebra/dense.h"
#include "analysis/natural_modes.h"
#include "messages/input_error.h"
#include "random_systems.h"

namespace whirl_twin {
namespace frequency_response_test {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Linearization undamped(const RandomSystem& s) {
  const MatrixXd zero = MatrixXd::Zero(s.mass.rows(), s.mass.cols());
  return {s.mass, zero, zero, s.stiffness, zero};
}

TEST(Receptance, IsSymmetricWithoutGyroscopicAndCirculatoryForces) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 1 + trial % 6;
    Linearization system = undamped(randomSystem(n, random));
    system.damping = randomSystem(n, random).stiffness;
    const MatrixXcd x = receptance(system, 3.0);
    EXPECT_LT((x - x.transpose()).norm(), 1e-10 * x.norm());
  }
}

TEST(Receptance, TransposesWithTheDirectionOfRotation) {
  // Gyroscopic and circulatory forces change sign with the speed: cause and effect change places.
  std::mt19937 random(22);
  Linearization system = undamped(randomSystem(4, random));
  system.damping = randomSystem(4, random).stiffness;
  const MatrixXd a = randomVector(16, random).reshaped(4, 4);
  const MatrixXd b = randomVector(16, random).reshaped(4, 4);
  system.gyroscopic = a - a.transpose();
  system.circulatory = b - b.transpose();
  Linearization backwards = system;
  backwards.gyroscopic *= -1.0;
  backwards.circulatory *= -1.0;
  const MatrixXcd x = receptance(system, 0.7);
  EXPECT_LT((x - receptance(backwards, 0.7).transpose()).norm(), 1e-11 * x.norm());
  EXPECT_GT((x - x.transpose()).norm(), 1e-3 * x.norm());
}

TEST(Receptance, AtRestIsTheInfluenceCoefficients) {
  std::mt19937 random(23);
  for (int trial = 0; trial < 50; ++trial) {
    Linearization system = undamped(randomSystem(4, random));
    system.damping = randomSystem(4, random).stiffness;
    const MatrixXd a = influenceCoefficients(system.stiffness);
    const MatrixXcd rest = receptance(system, 0.0);
    EXPECT_LT((rest - a).norm(), 1e-10 * a.norm());
    // W c a, the first term that vibration adds: c and a reach 1e2.
    EXPECT_LT((receptance(system, 1e-12) - a).norm(), 1e-7 * a.norm());
  }
}

TEST(Receptance, IsTheSumOverTheModesWithoutDamping) {
  std::mt19937 random(24);
  const RandomSystem s = randomSystem(5, random);
  const NaturalModes modes = naturalModes(s.mass, s.stiffness);
  const double w = 0.5 * (modes.frequencies[1] + modes.frequencies[2]);
  const VectorXd gain = (modes.frequencies.array().square() - w * w).inverse();
  const MatrixXd sum = modes.shapes * gain.asDiagonal() * modes.shapes.transpose();
  const MatrixXcd x = receptance(undamped(s), w);
  EXPECT_LT((x - sum).norm(), 1e-10 * sum.norm());
}

TEST(SteadyResponse, OfOneCoordinateIsTheClosedForm) {
  const double m = 2.0;
  const double c = 1.5;
  const double k = 75.0;
  const auto one = [](double value) { return MatrixXd::Constant(1, 1, value); };
  const Linearization system{one(m), one(c), one(0.0), one(k), one(0.0)};
  for (const double w : {0.0, 1.0, std::sqrt(k / m), 30.0}) {
    const std::complex<double> x =
        steadyResponse(system, Eigen::VectorXcd::Constant(1, 10.0), w)[0];
    EXPECT_NEAR(std::abs(x), 10.0 / std::hypot(k - m * w * w, c * w), 1e-12);
    EXPECT_NEAR(-std::arg(x), std::atan2(c * w, k - m * w * w), 1e-12);  // the lag
  }
}

TEST(SteadyResponse, HasNoAmplitudeAtAnUndampedResonance) {
  std::mt19937 random(25);
  for (int trial = 0; trial < 50; ++trial) {
    const RandomSystem s = randomSystem(3, random);
    for (const double p : naturalModes(s.mass, s.stiffness).frequencies) {
      EXPECT_THROW(receptance(undamped(s), p), RunFailure) << trial;
      EXPECT_NO_THROW(receptance(undamped(s), p * (1.0 + 1e-6))) << trial;
    }
  }
  const RandomSystem s = randomSystem(2, random);
  const double p = naturalModes(s.mass, s.stiffness).frequencies[0];
  try {
    receptance(undamped(s), p);
    ADD_FAILURE() << "not refused";
  } catch (const RunFailure& error) {
    EXPECT_NE(std::string(error.what()).find("undamped resonance"), std::string::npos);
  }
}

TEST(SteadyResponse, AConstantForceOnAFreeBodyHasNone) {
  Linearization system = undamped({MatrixXd::Identity(5, 5), freeBeamStiffness(5)});
  EXPECT_THROW(receptance(system, 0.0), RunFailure);
  EXPECT_NO_THROW(receptance(system, 0.01));
  EXPECT_THROW(steadyResponse(system, Eigen::VectorXcd::Ones(4), 1.0), InputError);
  EXPECT_THROW(receptance(system, NAN), InputError);
}

}  // namespace frequency_response_test
}  // namespace whirl_twin
