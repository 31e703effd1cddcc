// Undamped critical speeds of both directions against closed forms.
#include "analysis/undamped_critical_speeds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "messages/input_error.h"
#include "rotors_under_test.h"

namespace whirl_twin {

namespace undamped_critical_speeds_test {

// Of the overhung disc det(K - w^2 diag(m, Id -+ Ip)) = 0: two backward speeds, and with Ip > Id
// one forward.
TEST(UndampedCriticalSpeeds, OfAnOverhungDisc) {
  const auto reference = rotorCase("C01");
  const RotorUnderTest r = matrixRotor(reference);
  const Linearization l = r.rotor.matrices(0.0);
  const double k11 = l.stiffness(0, 0), k12 = l.stiffness(0, 2), k22 = l.stiffness(2, 2);
  const double m = l.mass(0, 0), diametral = l.mass(2, 2), polar = reference["parameters"]["Ip"];
  const auto found = undampedCriticalSpeeds(r.rotor, r.stations, 1.0e4);
  std::vector<double> expected_forward, expected_backward;
  for (const double sign : {1.0, -1.0}) {
    const double inertia = diametral - sign * polar;
    const double a = m * inertia, b = -(m * k22 + inertia * k11), c = k11 * k22 - k12 * k12;
    for (const double root : {(-b - std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a),
                              (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a)}) {
      if (root > 0.0) {
        (sign > 0.0 ? expected_forward : expected_backward).push_back(std::sqrt(root));
      }
    }
  }
  ASSERT_EQ(expected_forward.size(), 1u);
  ASSERT_EQ(expected_backward.size(), 2u);
  std::vector<double> forward, backward;
  for (const auto& one : found) {
    (one.whirl == Whirl::kForward ? forward : backward).push_back(one.speed);
  }
  ASSERT_EQ(forward.size(), 1u);
  ASSERT_EQ(backward.size(), 2u);
  EXPECT_NEAR(forward[0] / expected_forward[0], 1.0, 1.0e-12);
  EXPECT_NEAR(backward[0] / expected_backward[0], 1.0, 1.0e-12);
  EXPECT_NEAR(backward[1] / expected_backward[1], 1.0, 1.0e-12);
}

// Without gyroscopic moments both directions have one critical speed, at the natural frequency.
TEST(UndampedCriticalSpeeds, OfARoundRotorWithoutGyroscopicMomentsComeInPairs) {
  const RotorUnderTest r = chainRotor(3);
  const auto found = undampedCriticalSpeeds(r.rotor, r.stations, 5.0e3);
  ASSERT_EQ(found.size(), 6u);
  for (std::size_t i = 0; i < 6; i += 2) {
    EXPECT_NEAR(found[i].speed, found[i + 1].speed, 1.0e-9 * found[i].speed);
    EXPECT_EQ(found[i].whirl, Whirl::kBackward);
    EXPECT_EQ(found[i + 1].whirl, Whirl::kForward);
  }
}

// A spring that stiffens with the speed, k = k_0 (1 + (w/w_1)^2), moves p^2 to k_0/(m - k_0/w_1^2).
TEST(UndampedCriticalSpeeds, FollowBearingsThatFollowTheSpeed) {
  RotorUnderTest r;
  const double w1 = 400.0;
  r.rotor.matrices = [=](double w) {
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2), none = 0.0 * one;
    return Linearization{2.0 * one, none, none, 180000.0 * (1.0 + w * w / (w1 * w1)) * one, none};
  };
  r.rotor.speed_dependent = true;
  r.rotor.load = Eigen::VectorXd::Zero(2);
  r.stations = {{"disc", 0.0, Eigen::VectorXd::Unit(2, 0), Eigen::VectorXd::Unit(2, 1)}};
  const auto found = undampedCriticalSpeeds(r.rotor, r.stations, 2.0e3);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].speed, std::sqrt(180000.0 / (2.0 - 180000.0 / (w1 * w1))), 1.0e-9);
}

TEST(UndampedCriticalSpeeds, RiseWithTheBearingsToTheRotorOnRigidOnes) {
  const auto lowest = [](double stiffness) {
    const RotorUnderTest r = chainRotor(3, stiffness);
    return undampedCriticalSpeeds(r.rotor, r.stations, 1.0e4).front().speed;
  };
  EXPECT_LT(lowest(1.0e4), lowest(1.0e5));
  EXPECT_LT(lowest(1.0e5), lowest(1.0e6));
  // Rigid bearings leave the middle disc between two springs: p^2 = 2 k / m.
  EXPECT_NEAR(lowest(1.0e12), 1000.0, 1.0e-2);
}

TEST(UndampedCriticalSpeeds, OfANegativeStiffnessAreRefused) {
  const RotorUnderTest r = chainRotor(3, -1.0e5);
  EXPECT_THROW(undampedCriticalSpeeds(r.rotor, r.stations, 1.0e3), RunFailure);
}

TEST(UndampedCriticalSpeeds, OfAFreeRotorLeaveOutItsDrift) {
  const RotorUnderTest r = chainRotor(3, 0.0);
  const auto found = undampedCriticalSpeeds(r.rotor, r.stations, 1.0e4);
  ASSERT_EQ(found.size(), 4u);
  // The rigid-body drift is separated from a vibration by soft springs: they cost half the digits.
  EXPECT_NEAR(found[0].speed, std::sqrt(5.0e5), 1.0e-2);
}

}  // namespace undamped_critical_speeds_test

}  // namespace whirl_twin
