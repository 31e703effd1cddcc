#include "integration/linear_step.h"

#include <cmath>

#include "integration/linear_methods.h"

namespace whirl_twin {

namespace {

/// W as an upper triangle by blocks: y^T W y = y^T U y, with the terms of states and phasors
/// together in the rows of the phasors, so that without damping and circulatory forces the rows of
/// the states are zero.
Eigen::MatrixXd withoutUpperBlock(const Eigen::MatrixXd& work, Eigen::Index states) {
  const Eigen::Index phasors = work.rows() - states;
  Eigen::MatrixXd u = work;
  u.bottomLeftCorner(phasors, states) += work.topRightCorner(states, phasors).transpose();
  u.topRightCorner(states, phasors).setZero();
  return u;
}

}  // namespace

LinearMotion::LinearMotion(Eigen::Index n)
    : q(Eigen::VectorXd::Zero(n)),
      v(Eigen::VectorXd::Zero(n)),
      q_low(Eigen::VectorXd::Zero(n)),
      v_low(Eigen::VectorXd::Zero(n)) {}

LinearStep::LinearStep(const LinearModel& model, const std::string& method, double h)
    : n_(model.mass.rows()) {
  const LinearEquation equation(model);
  frequencies_ = equation.frequencies();
  const Eigen::Index size = equation.size();
  y_.setZero(size);
  const LinearStepMap map = linearStepMap(equation, method, h);
  const Eigen::MatrixXd work = withoutUpperBlock(map.work, 2 * n_);
  const bool conservative = (work.topRows(2 * n_).array() == 0.0).all();
  const Eigen::Index rows = conservative ? size - 2 * n_ : size;
  map_.resize(2 * n_ + rows, size);
  map_.topRows(2 * n_) = map.increment;
  map_.bottomRows(rows) = work.bottomRows(rows);
  result_.setZero(map_.rows());
}

void LinearStep::advance(double time, LinearMotion& motion) noexcept {
  y_.head(n_) = motion.q;
  y_.segment(n_, n_) = motion.v;
  double* phasor = y_.data() + 2 * n_;
  for (const double frequency : frequencies_) {
    *phasor++ = std::cos(frequency * time);
    *phasor++ = std::sin(frequency * time);
  }
  result_.noalias() = map_ * y_;
  const Eigen::Index rows = result_.size() - 2 * n_;
  motion.work.add(y_.tail(rows).dot(result_.tail(rows)));
  for (Eigen::Index i = 0; i < n_; ++i) {
    CompensatedSum position{motion.q[i], motion.q_low[i]};
    position.add(result_[i]);
    motion.q[i] = position.high;
    motion.q_low[i] = position.low;
    CompensatedSum rate{motion.v[i], motion.v_low[i]};
    rate.add(result_[n_ + i]);
    motion.v[i] = rate.high;
    motion.v_low[i] = rate.low;
  }
}

}  // namespace whirl_twin
