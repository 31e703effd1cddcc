// Matrix iteration finds the modes of the eigenvalue solver, or reports failure.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/QR>

#include "algebra/dense.h"
#include "analysis/approximate_frequencies.h"
#include "analysis/natural_modes.h"
#include "messages/input_error.h"
#include "random_systems.h"

namespace whirl_twin {
namespace matrix_iteration_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(MatrixIteration, FindsTheModesOfRandomSystems) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 6;
    const RandomSystem s = randomSystem(n, random);
    const NaturalModes exact = naturalModes(s.mass, s.stiffness);
    const std::vector<IteratedMode> modes =
        matrixIteration(s.mass, s.stiffness, n, randomVector(n, random));
    ASSERT_EQ(static_cast<int>(modes.size()), n) << trial;
    for (int i = 0; i < n; ++i) {
      ASSERT_TRUE(modes[i].converged) << trial;
      // The tolerance of 1e-9 on 1 / p^2 bounds the error of p; conditions to 1e8 add rounding.
      EXPECT_NEAR(modes[i].frequency, exact.frequencies[i], 1e-8 * exact.frequencies[i]) << trial;
      EXPECT_NEAR(modes[i].shape.dot(s.mass * modes[i].shape), 1.0, 1e-12);
    }
  }
}

TEST(MatrixIteration, EachStepShrinksTheErrorByTheRatioOfTheRoots) {
  const MatrixXd mass = MatrixXd::Identity(2, 2);
  const MatrixXd stiffness = Eigen::Vector2d(1.0, 4.0).asDiagonal();
  const IteratedMode mode = matrixIteration(mass, stiffness, 1, Eigen::Vector2d(1.0, 1.0)).front();
  // The other mode shrinks to a quarter each step, its part in p^2 to a sixteenth.
  for (int step = 3; step < 8; ++step) {
    EXPECT_NEAR((mode.history[step] - 1.0) / (mode.history[step - 1] - 1.0), 1.0 / 16.0, 1e-3);
  }
  EXPECT_LT(mode.history.size(), 40u);
}

TEST(MatrixIteration, AStartOrthogonalToTheFirstModeStillFindsIt) {
  const MatrixXd mass = MatrixXd::Identity(3, 3);
  const MatrixXd stiffness = Eigen::Vector3d(1.0, 4.0, 9.0).asDiagonal();
  const VectorXd third = VectorXd::Unit(3, 2);
  const std::vector<IteratedMode> modes = matrixIteration(mass, stiffness, 3, third);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(modes[i].converged);
    EXPECT_NEAR(modes[i].frequency, i + 1.0, 1e-9);
  }
}

TEST(MatrixIteration, OfEqualRootsFindsAsManyModes) {
  // Two equal roots, two others; turned so that no coordinate is a mode.
  std::mt19937 random(12);
  const MatrixXd turn =
      Eigen::HouseholderQR<MatrixXd>(MatrixXd(randomVector(16, random).reshaped(4, 4)))
          .householderQ();
  const MatrixXd stiffness =
      turn * Eigen::Vector4d(4.0, 4.0, 9.0, 16.0).asDiagonal() * turn.transpose();
  const MatrixXd mass = MatrixXd::Identity(4, 4);
  const std::vector<IteratedMode> modes =
      matrixIteration(mass, stiffness, 4, randomVector(4, random));
  ASSERT_EQ(modes.size(), 4u);
  EXPECT_NEAR(modes[0].frequency, 2.0, 1e-9);
  EXPECT_NEAR(modes[1].frequency, 2.0, 1e-9);
  EXPECT_NEAR(modes[0].shape.dot(modes[1].shape), 0.0, 1e-9);
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT((stiffness * modes[i].shape - 4.0 * modes[i].shape).norm(), 1e-7);
  }
  EXPECT_NEAR(modes[2].frequency, 3.0, 1e-9);
  EXPECT_NEAR(modes[3].frequency, 4.0, 1e-9);
}

TEST(MatrixIteration, SaysThatItDidNotConverge) {
  std::mt19937 random(13);
  const RandomSystem s = randomSystem(5, random);
  IterationLimits limits;
  limits.most_steps = 3;
  const std::vector<IteratedMode> modes =
      matrixIteration(s.mass, s.stiffness, 5, VectorXd::Ones(5), limits);
  ASSERT_EQ(modes.size(), 1u);  // nothing can be swept by a mode that is not known
  EXPECT_FALSE(modes[0].converged);
  EXPECT_EQ(modes[0].history.size(), 3u);
  EXPECT_GE(modes[0].frequency, naturalModes(s.mass, s.stiffness).frequencies[0]);
}

TEST(MatrixIteration, RefusesWhatHasNoDynamicalMatrix) {
  const MatrixXd one = MatrixXd::Identity(4, 4);
  EXPECT_THROW(matrixIteration(one, freeBeamStiffness(4), 1, VectorXd::Ones(4)), RunFailure);
  EXPECT_THROW(matrixIteration(one, one, 1, VectorXd::Zero(4)), InputError);
  EXPECT_THROW(matrixIteration(one, one, 0, VectorXd::Ones(4)), InputError);
  EXPECT_THROW(matrixIteration(one, one, 5, VectorXd::Ones(4)), InputError);
  EXPECT_THROW(matrixIteration(0.0 * one, one, 1, VectorXd::Ones(4)), InputError);
}

}  // namespace matrix_iteration_test
}  // namespace whirl_twin
