// A step of linearized equations y' = A y + (0, f), y the coordinates and rates of n coordinates:
// the matrix exponential of A, and what accelerations f on the way come to, by Gauss's three nodes.
#pragma once

#include <Eigen/Core>
#include <array>

namespace whirl_twin {

struct MotionStep {
  /// Of the step, from 0 to 1.
  static constexpr std::array<double, 3> kNode = {0.11270166537925831, 0.5, 0.88729833462074169};
  static constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};

  MotionStep() = default;
  /// by_state [n x 2n]: accelerations by coordinates and rates; duration [s].
  MotionStep(const Eigen::MatrixXd& by_state, double duration);

  /// The covariance [2n x 2n] that white accelerations of a density [n x n, (m/s^2)^2/Hz] make.
  Eigen::MatrixXd noiseOf(const Eigen::MatrixXd& density) const;

  double duration = 0.0;                ///< [s]
  Eigen::MatrixXd states;               ///< e^(A h) [2n x 2n]
  std::array<Eigen::MatrixXd, 3> node;  ///< what f at a node comes to [2n x n]
  Eigen::MatrixXd forced;               ///< their sum: what an f that stays comes to
  Eigen::MatrixXd noise;                ///< of white accelerations of density 1 [2n x 2n]
};

}  // namespace whirl_twin
