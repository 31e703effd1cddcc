// Robust standard deviations of a filter's estimates: their ratio to those of its covariance, for
// residuals that are not white (hum, an unmodelled order of the shaft, outliers): the sandwich
// covariance P J P of H. White (Econometrica 48, 1980) with the lagged terms of W. Newey and K.
// West (Econometrica 55, 1987).
//
// A block of time b adds the information G_b = I_b - I_(b-1) and G_b x = h_b = I_b x_b - I_(b-1)
// x_(b-1), with estimates x and I = P^-1. Its deviation from the estimate of all blocks is the
// score s_b = h_b - G_b x. For white residuals the sum of s_b s_b' equals that of G_b. For others,
// whose correlation ends within a block or the next one, the information J of the scores is
//
//   J = J_0 + sum s_b s_b' + (s_b s_(b-1)' + s_(b-1) s_b', if positive)
//
// J_0 is the information of the start. With random walks, earlier blocks are discounted by
// (I_(b-1)^-1 + Q)^-1 I_(b-1)^-1. A variance from few blocks is uncertain: its square root is
// multiplied by the ratio of Student's 97.5 % point to the normal one, with the degrees of freedom
// (sum w)^2 / sum w^2 - 1 from the blocks' shares w of the information.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace whirl_twin {

class RobustCovariance {
 public:
  /// sizes: initial standard deviations, in the units of the numbers; 0: not estimated.
  /// walk: variance per time of the random walk of each number.
  RobustCovariance(const Eigen::VectorXd& sizes, const Eigen::VectorXd& walk);

  /// Adds the estimates at the end of a block of a duration [s], and their covariance.
  void add(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance, double duration);
  /// The estimates have changed for a reason other than samples. The factors are kept.
  void resume(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance);
  /// All estimates have been reset to these; their covariance is exact.
  void restart(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance);

  /// Ratio of the standard deviation to that of the covariance, at least 1, for each number.
  const Eigen::VectorXd& factors() const { return factors_; }

 private:
  struct Block {
    Eigen::MatrixXd information;  // G
    Eigen::VectorXd weighted;     // h
  };

  /// The estimated numbers, relative to sizes.
  Eigen::VectorXd scaled(const Eigen::VectorXd& numbers) const;
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& covariance) const;
  void setLast(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance);
  void judge();
  void mergeLeast(const std::vector<double>& shares);

  Eigen::Index all_;
  std::vector<Eigen::Index> estimated_;
  Eigen::VectorXd sizes_, walk_;  // of the estimated numbers
  Eigen::VectorXd last_;
  Eigen::MatrixXd covariance_, information_;  // of the last block
  Eigen::MatrixXd start_;                     // J_0
  std::vector<Block> blocks_;
  Eigen::VectorXd factors_;
};

}  // namespace whirl_twin
