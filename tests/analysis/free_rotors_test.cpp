// Stability of free-free systems: with M > 0, K >= 0, skew G and no damping nothing can grow, and
// rounding of the zero eigenvalues of rigid-body motion must not change that verdict.
#include "free_rotors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "algebra/dense.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/instability_speed.h"
#include "analysis/whirl_modes.h"
#include "mechanics/linear_rotor_dynamics.h"
#include "random_systems.h"

namespace whirl_twin {
namespace free_rotors_test {

using Eigen::MatrixXd;

struct Floating {
  int elements;
  bool reduced;
};

class FreeRotor : public testing::TestWithParam<Floating> {
 protected:
  static LinearRotor rotor(double length, double polar_inertia, double internal_damping = 0.0) {
    const FlexibleShaft shaft =
        freeShaft(GetParam().elements, length, polar_inertia, internal_damping);
    return GetParam().reduced ? reducedFreeRotor(shaft) : freeRotor(shaft);
  }
};

TEST_P(FreeRotor, NeitherGrowsNorDecaysWithoutDamping) {
  const LinearRotor rotor = this->rotor(1.0, 0.1);
  const auto dof = static_cast<std::size_t>(rotor.dof());
  for (const double speed : {0.0, 1.0, 100.0, 1000.0, 5000.0}) {
    const Linearization l = rotor.matrices(speed);
    const CyclicCoordinates rigid = rigidBodyMotions(l);
    // Turning, the two tilts feel the gyroscopic moment; the two translations never do.
    EXPECT_EQ(rigid.conserved.size(), speed == 0.0 ? 4u : 2u) << speed;
    EXPECT_EQ(rigid.driven.size(), speed == 0.0 ? 0u : 2u) << speed;
    const Stability shape = reducedStability(l, rigid);
    EXPECT_EQ(shape.routh.verdict, Verdict::kMarginal) << speed;
    EXPECT_EQ(shape.routh.right, 0) << speed;
    EXPECT_EQ(shape.decay_rate, 0.0) << speed;
    // A push sets it adrift for ever.
    const Stability all = stabilityWithRigidBodyModes(l, rigid);
    EXPECT_EQ(all.routh.verdict, Verdict::kRepeatedImaginary) << speed;
    EXPECT_EQ(all.eigenvalues.size(), 2 * dof);
    EXPECT_EQ(all.routh.imaginary, static_cast<int>(2 * dof)) << speed;
    EXPECT_EQ(std::count(all.eigenvalues.begin(), all.eigenvalues.end(), 0.0), speed == 0.0 ? 8 : 6)
        << speed;
    const WhirlModes modes = whirlModes(l, {});
    EXPECT_EQ(modes.modes.size(), speed == 0.0 ? dof - 4 : dof - 3) << speed;
    for (const WhirlMode& mode : modes.modes) {
      EXPECT_EQ(mode.eigenvalue.real(), 0.0) << speed;
    }
  }
}

TEST_P(FreeRotor, HasNoSpeedAtWhichItTurnsUnstable) {
  const LinearRotor rotor = this->rotor(1.0, 0.1);
  std::vector<CoordinateInfo> coordinates(static_cast<std::size_t>(rotor.dof()), {"q", "m"});
  const LinearRotorDynamics dynamics({"free_rotor", coordinates, {}}, rotor);
  EXPECT_FALSE(instabilitySpeed(dynamics, Eigen::VectorXd::Zero(rotor.dof()), 0.0).has_value());
}

// Explorer 1: a body that gives inside keeps its momentum but not its energy, and turns towards its
// axis of largest inertia. About its long axis it does not stay; a flat one does.
TEST_P(FreeRotor, WithInternalDampingTurnsStablyOnlyIfItIsFlat) {
  for (const double polar_inertia : {0.1, 3.0}) {
    const LinearRotor rotor = this->rotor(polar_inertia > 1.0 ? 0.4 : 1.0, polar_inertia, 1.0e-4);
    const Linearization l = rotor.matrices(100.0);
    const Stability shape = reducedStability(l, rigidBodyMotions(l));
    if (polar_inertia > 1.0) {
      EXPECT_EQ(shape.routh.right, 0);
      EXPECT_NE(shape.routh.verdict, Verdict::kUnstable);
    } else {
      EXPECT_EQ(shape.routh.verdict, Verdict::kUnstable);
      EXPECT_EQ(shape.routh.right, 2);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, FreeRotor,
                         testing::Values(Floating{1, false}, Floating{2, false}, Floating{3, false},
                                         Floating{5, false}, Floating{12, false}, Floating{4, true},
                                         Floating{9, true}),
                         [](const auto& test) {
                           return std::to_string(test.param.elements) + "Elements" +
                                  (test.param.reduced ? "Reduced" : "");
                         });

/// `copies` of a system of two coordinates, their coordinates mixed by random combinations.
Linearization mixed(const Eigen::Matrix2d& stiffness, double gyroscopic, int copies,
                    std::mt19937& random) {
  const int n = 2 * copies;
  Linearization l;
  for (MatrixXd* m : {&l.mass, &l.damping, &l.gyroscopic, &l.stiffness, &l.circulatory}) {
    *m = MatrixXd::Zero(n, n);
  }
  l.mass.setIdentity();
  for (int i = 0; i < n; i += 2) {
    l.stiffness.block<2, 2>(i, i) = (1.0 + i) * stiffness;
    l.gyroscopic(i, i + 1) = gyroscopic;
    l.gyroscopic(i + 1, i) = -gyroscopic;
  }
  MatrixXd mix(n, n);
  for (int i = 0; i < n; ++i) {
    mix.col(i) = randomVector(n, random);
  }
  mix = orthogonalFactor(mix);
  for (MatrixXd* m : {&l.mass, &l.stiffness}) {
    const MatrixXd turned = mix.transpose() * *m * mix;
    *m = 0.5 * (turned + turned.transpose());
  }
  const MatrixXd turned = mix.transpose() * l.gyroscopic * mix;
  l.gyroscopic = 0.5 * (turned - turned.transpose());
  return l;
}

// A charge in a magnetic field circles: its zero eigenvalues are simple, and nothing runs away. One
// that can slide along a line is pressed aside, and slides on: that is a drift.
TEST(FreeSystems, GyroscopicForcesHoldOrDoNot) {
  std::mt19937 random(5);
  const Eigen::Matrix2d none = Eigen::Matrix2d::Zero();
  const Eigen::Matrix2d aside = Eigen::Vector2d(0.0, 9.0).asDiagonal();
  for (const int copies : {1, 2, 4, 5, 7}) {
    for (const double gyroscopic : {1.0e-3, 1.0, 50.0}) {
      const Linearization circling = mixed(none, gyroscopic, copies, random);
      const CyclicCoordinates rigid = rigidBodyMotions(circling);
      EXPECT_EQ(rigid.driven.size(), 2u * copies);
      EXPECT_EQ(stabilityWithRigidBodyModes(circling, rigid).routh.verdict, Verdict::kMarginal);

      const Linearization sliding = mixed(aside, gyroscopic, copies, random);
      const CyclicCoordinates along = rigidBodyMotions(sliding);
      EXPECT_EQ(along.driven.size(), 1u * copies);
      const Stability shape = reducedStability(sliding, along);
      EXPECT_EQ(shape.routh.verdict, Verdict::kMarginal) << copies << " " << gyroscopic;
      EXPECT_EQ(shape.routh.right, 0);
      EXPECT_EQ(stabilityWithRigidBodyModes(sliding, along).routh.verdict,
                Verdict::kRepeatedImaginary);
    }
  }
}

// Negative stiffness is not rounding, however small relative to the others.
TEST(FreeSystems, ASoftSpringThatPushesIsUnstable) {
  for (const int n : {2, 12}) {
    Linearization l;
    l.mass = MatrixXd::Identity(n, n);
    l.damping = l.gyroscopic = l.circulatory = MatrixXd::Zero(n, n);
    l.stiffness = 1.0e9 * MatrixXd::Identity(n, n);
    l.stiffness(0, 0) = -1.0;
    EXPECT_EQ(stability(l).routh.verdict, Verdict::kUnstable);
    EXPECT_EQ(stability(l).routh.right, 1);
  }
}

}  // namespace free_rotors_test
}  // namespace whirl_twin
