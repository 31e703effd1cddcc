// A Kalman filter of any size with sequential scalar measurement updates. Covariances are updated
// in Joseph's form, which keeps them symmetric and positive for a large initial uncertainty and an
// accurate sensor (P. D. Joseph; R. G. Brown, P. Y. C. Hwang, Introduction to Random Signals and
// Applied Kalman Filtering, sec. 5.2).
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
  /// [size x size]; each entry in the product of its two units.
  const Eigen::MatrixXd& covariance() const { return p_; }
  double deviation(Eigen::Index number) const;

  /// Propagates the covariance over a step: P = F P F' + Q.
  void propagate(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& noise);
  /// Sets the standard deviation of a state and makes it independent of all others.
  void forget(Eigen::Index number, double deviation);
  /// Makes `count` states from `first` on independent of all others.
  void separate(Eigen::Index first, Eigen::Index count);

  /// Prediction of a measurement h'x with noise of a standard deviation.
  struct Expected {
    double value = 0.0;      ///< h'x
    double deviation = 0.0;  ///< of the measured value, noise included
  };
  Expected expect(const Eigen::VectorXd& h, double deviation) const;
  /// Measurement update. States from `considered` on contribute their uncertainty but are not
  /// updated.
  void take(const Eigen::VectorXd& h, double measured, double deviation, Eigen::Index considered);

 private:
  Eigen::VectorXd x_;
  Eigen::MatrixXd p_;
  // Work space:
  Eigen::VectorXd gain_;
  Eigen::VectorXd ph_;  // P h
  Eigen::MatrixXd fp_;  // F P
};

}  // namespace whirl_twin
