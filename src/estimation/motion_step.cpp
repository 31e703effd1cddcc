#include "estimation/motion_step.h"

#include "integration/matrix_exponential.h"

namespace whirl_twin {

MotionStep::MotionStep(const Eigen::MatrixXd& by_state, double h) : duration(h) {
  const Eigen::Index n = by_state.rows();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomRows(n) = by_state;
  const auto power = [&](double part) {
    Eigen::MatrixXd e = exponentialLessIdentity<Eigen::Dynamic>(part * h * A);
    e.diagonal().array() += 1.0;
    return e;
  };
  states = power(1.0);
  forced = Eigen::MatrixXd::Zero(2 * n, n);
  noise = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (std::size_t k = 0; k < kNode.size(); ++k) {
    const Eigen::MatrixXd rates = power(1.0 - kNode[k]).rightCols(n);
    node[k] = kWeight[k] * h * rates;
    forced += node[k];
    noise.noalias() += kWeight[k] * h * rates * rates.transpose();
  }
}

Eigen::MatrixXd MotionStep::noiseOf(const Eigen::MatrixXd& density) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(states.rows(), states.cols());
  for (std::size_t k = 0; k < kNode.size(); ++k) {
    all += node[k] * density * node[k].transpose() / (kWeight[k] * duration);
  }
  return all;
}

}  // namespace whirl_twin
