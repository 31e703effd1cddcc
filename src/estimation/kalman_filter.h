// A Kalman filter of any size: a state, what is not known of it, and measurements taken one number
// at a time. Covariances are updated in Joseph's form, which keeps them symmetric and positive
// where a start that is hardly known meets a sensor that is very good (P. D. Joseph; R. G. Brown,
// P. Y. C. Hwang, Introduction to Random Signals and Applied Kalman Filtering, sec. 5.2).
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

class KalmanFilter {
 public:
  KalmanFilter() = default;
  KalmanFilter(Eigen::VectorXd state, const Eigen::VectorXd& deviation);

  Eigen::Index size() const { return x_.size(); }
  const Eigen::VectorXd& state() const { return x_; }
  Eigen::VectorXd& state() { return x_; }
  /// [size x size]; each entry in the units of its two numbers.
  const Eigen::MatrixXd& covariance() const { return p_; }
  double deviation(Eigen::Index number) const;

  /// The covariance goes through a step: P = F P F' + Q.
  void propagate(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& noise);
  /// Makes a number this uncertain, and independent of all others.
  void forget(Eigen::Index number, double deviation);
  /// Makes so many numbers from `first` on independent of all others.
  void separate(Eigen::Index first, Eigen::Index count);

  /// What a measurement of h'x with noise of a standard deviation is expected to be.
  struct Expected {
    double value = 0.0;      ///< h'x
    double deviation = 0.0;  ///< of what is measured from it, noise and all
  };
  Expected expect(const Eigen::VectorXd& h, double deviation) const;
  /// Takes a measured value. Numbers from `considered` on count as uncertain and stay as they are.
  void take(const Eigen::VectorXd& h, double measured, double deviation, Eigen::Index considered);

 private:
  Eigen::VectorXd x_;
  Eigen::MatrixXd p_;
  // Kept to save the room:
  Eigen::VectorXd gain_;
  Eigen::VectorXd ph_;  // P h
  Eigen::MatrixXd fp_;  // F P
};

}  // namespace whirl_twin
