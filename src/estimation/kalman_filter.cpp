#include "estimation/kalman_filter.h"

#include <cmath>
#include <utility>

namespace whirl_twin {

KalmanFilter::KalmanFilter(Eigen::VectorXd state, const Eigen::VectorXd& deviation)
    : x_(std::move(state)), p_(deviation.cwiseAbs2().asDiagonal()) {}

double KalmanFilter::deviation(Eigen::Index number) const {
  return std::sqrt(std::max(0.0, p_(number, number)));
}

void KalmanFilter::propagate(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& noise) {
  fp_.noalias() = transition * p_;
  p_.noalias() = fp_ * transition.transpose();
  p_ += noise;
  // Rounding makes the matrix unsymmetric, an error that would grow.
  fp_ = p_.transpose();
  p_ = 0.5 * (p_ + fp_);
}

void KalmanFilter::forget(Eigen::Index number, double deviation) {
  p_.row(number).setZero();
  p_.col(number).setZero();
  p_(number, number) = deviation * deviation;
}

void KalmanFilter::separate(Eigen::Index first, Eigen::Index count) {
  fp_ = p_.block(first, first, count, count);
  p_.middleRows(first, count).setZero();
  p_.middleCols(first, count).setZero();
  p_.block(first, first, count, count) = fp_;
}

KalmanFilter::Expected KalmanFilter::expect(const Eigen::VectorXd& h, double deviation) const {
  return {h.dot(x_), std::sqrt(std::max(0.0, h.dot(p_ * h)) + deviation * deviation)};
}

void KalmanFilter::take(const Eigen::VectorXd& h, double measured, double deviation,
                        Eigen::Index considered) {
  const double r = deviation * deviation;
  ph_.noalias() = p_ * h;
  const double s = h.dot(ph_) + r;
  if (!(s > 0.0)) {  // exactly known already
    gain_ = Eigen::VectorXd::Zero(size());
    return;
  }
  gain_ = ph_ / s;
  gain_.tail(size() - considered).setZero();
  x_ += gain_ * (measured - h.dot(x_));
  // (I - k h') P (I - k h')' + k r k'
  p_.noalias() -= gain_ * ph_.transpose();
  ph_.noalias() = p_ * h;
  p_.noalias() -= ph_ * gain_.transpose();
  p_.noalias() += r * gain_ * gain_.transpose();
}

}  // namespace whirl_twin
