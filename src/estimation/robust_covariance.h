// How much larger the standard deviations of a filter's estimates are than its covariance says,
// where residuals are not white (hum, an order of the shaft that the model has not, outliers): the
// sandwich covariance P J P of H. White (Econometrica 48, 1980) with the lagged terms of W. Newey
// and K. West (Econometrica 55, 1987).
//
// A block of time b adds the information G_b = I_b - I_(b-1) and G_b x = h_b = I_b x_b -
// I_(b-1) x_(b-1), of estimates x and I = P^-1. What it alone says is off from the estimate of all
// blocks by the score s_b = h_b - G_b x. White residuals make the sum of s_b s_b' equal to that of
// G_b; others do not, as long as they forget within a block or the one after it:
//
//   J = J_0 + sum s_b s_b' + (s_b s_(b-1)' + s_(b-1) s_b', if positive)
//
// J_0 is the information of the start. Where numbers walk, blocks before count for less, by
// (I_(b-1)^-1 + Q)^-1 I_(b-1)^-1. A variance from few blocks is uncertain: its root is taken times
// Student's 97.5 % point over the normal one, with as many degrees of freedom as blocks share the
// information, (sum w)^2 / sum w^2, less one.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace whirl_twin {

class RobustCovariance {
 public:
  /// sizes: standard deviations at the start, of the numbers' units; 0: not estimated.
  /// walk: of each, its own change in a time t has the variance walk t.
  RobustCovariance(const Eigen::VectorXd& sizes, const Eigen::VectorXd& walk);

  /// The estimates at the end of a block of a duration [s], and their covariance.
  void add(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance, double duration);
  /// The estimates became others by something else than samples. What factors were stays.
  void resume(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance);
  /// All was forgotten, and these are the estimates: their covariance is right.
  void restart(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance);

  /// Of each number: its standard deviation over that of the covariance, at least 1.
  const Eigen::VectorXd& factors() const { return factors_; }

 private:
  struct Block {
    Eigen::MatrixXd information;  // G
    Eigen::VectorXd weighted;     // h
  };

  /// In sizes, of the numbers that are estimated.
  Eigen::VectorXd scaled(const Eigen::VectorXd& numbers) const;
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& covariance) const;
  void setLast(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance);
  void judge();
  void mergeLeast(const std::vector<double>& shares);

  Eigen::Index all_;
  std::vector<Eigen::Index> estimated_;
  Eigen::VectorXd sizes_, walk_;  // of these
  Eigen::VectorXd last_;
  Eigen::MatrixXd covariance_, information_;  // of the last
  Eigen::MatrixXd start_;                     // J_0
  std::vector<Block> blocks_;
  Eigen::VectorXd factors_;
};

}  // namespace whirl_twin
