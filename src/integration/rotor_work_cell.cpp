// Prepared quadrature cells of the work of a run-up's steps (rotor_work.h).
#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra/dense.h"
#include "integration/rotor_work.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Polynomial = std::array<MatrixXd, 3>;

constexpr double kIndependent = 1.0e-13;

/// Derivative of K with respect to the speed.
MatrixXd stiffnessSlope(const LinearRotor& rotor, double speed) {
  if (!rotor.speed_dependent) {
    return MatrixXd::Zero(rotor.dof(), rotor.dof());
  }
  const double step = 1.0e-4 * std::max(1.0, std::fabs(speed));
  const MatrixXd change =
      rotor.matrices(speed + step).stiffness - rotor.matrices(speed - step).stiffness;
  const double rounding = 1.0e-13 * rotor.matrices(speed).stiffness.cwiseAbs().maxCoeff();
  return change.cwiseAbs().maxCoeff() <= rounding ? MatrixXd::Zero(rotor.dof(), rotor.dof())
                                                  : MatrixXd(change / (2.0 * step));
}

/// Orthonormal columns that span those of all the matrices, each taken in its own size.
MatrixXd jointRange(const std::vector<MatrixXd>& matrices, Index n) {
  MatrixXd all(n, 0);
  for (const MatrixXd& matrix : matrices) {
    const double size = matrix.size() > 0 ? matrix.cwiseAbs().maxCoeff() : 0.0;
    if (size > 0.0) {
      all.conservativeResize(n, all.cols() + matrix.cols());
      all.rightCols(matrix.cols()) = matrix / size;
    }
  }
  if (all.cols() == 0) {
    return MatrixXd(n, 0);
  }
  const PivotedQr qr(all, kIndependent);
  return qr.orthogonal().leftCols(qr.rank());
}

MatrixXd phasorColumns(const std::vector<ForceChannel>& channels, Index n) {
  MatrixXd columns(n, 2 * static_cast<Index>(channels.size()));
  for (std::size_t k = 0; k < channels.size(); ++k) {
    columns.middleCols(2 * static_cast<Index>(k), 2) << channels[k].amplitude.real(),
        -channels[k].amplitude.imag();
  }
  return columns;
}

/// Phasors, load and inputs side by side.
MatrixXd allForces(const MatrixXd& phasors, const Eigen::VectorXd& load,
                   const MatrixXd& directions) {
  MatrixXd forces(load.size(), phasors.cols() + 1 + directions.cols());
  forces << phasors, load, directions;
  return forces;
}

/// The parabola through values at s = -1, 0, 1.
Polynomial parabola(const MatrixXd& below, const MatrixXd& middle, const MatrixXd& above) {
  return {middle, 0.5 * (above - below), 0.5 * (above + below) - middle};
}

}  // namespace

RotorWork::RotorWork(const LinearRotor& rotor, const std::vector<ForceChannel>& channels,
                     const AppliedInputs& acting, double h, const std::pair<double, double>& speeds,
                     bool driven)
    : h_(h), driven_(driven), channels_(channels), directions_(acting.directions()) {
  const Index n = rotor.dof();
  directions_.conservativeResize(n, Eigen::NoChange);
  const MatrixXd phasors = phasorColumns(channels, n);
  std::vector<MatrixXd> ranges{phasors, directions_};
  for (const double share : {0.0, 0.3, 0.7, 1.0}) {
    const double speed = speeds.first + share * (speeds.second - speeds.first);
    const Linearization l = rotor.matrices(speed);
    ranges.insert(ranges.end(), {l.damping, l.circulatory, stiffnessSlope(rotor, speed)});
  }
  basis_ = jointRange(ranges, n);
  force_.resize(basis_.cols(), phasors.cols() + directions_.cols());
  force_ << basis_.transpose() * phasors, basis_.transpose() * directions_;
  const Cholesky mass(rotor.matrices(speeds.first).mass);
  const MatrixXd forces = allForces(phasors, rotor.load, directions_);
  acceleration_by_force_ = basis_.transpose() * mass.solve(forces);

  Eigen::Matrix<double, 8, 8> ends;  // of 1, x, x^2 ... : value and derivatives at 0, at 1
  ends.setZero();
  for (int k = 0; k < 8; ++k) {
    double factor = 1.0;
    for (int d = 0; d < 4; ++d) {
      ends(4 + d, k) = factor;
      ends(d, k) = d == k ? factor : 0.0;
      factor *= k - d;
    }
  }
  hermite_ = Lu(ends).inverse().transpose();
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    weights_[i] = weightsAt(ShaftNodes::kNodes[i]);
  }

  const Index size = basis_.cols();
  const Index phasor_count = forces.cols();
  const Index padded = PackedMatrix(MatrixXd::Zero(4 * size, 1)).rows();
  from_.setZero(padded);
  to_.setZero(padded);
  jump_.setZero(2 * size);
  inputs_.setZero(10 * n + 4 * phasor_count);
  phasors_.setZero(phasor_count);
  rates_.setZero(phasor_count);
  for (Eigen::VectorXd* room : {&z_, &z_rate_, &pull_}) {
    room->setZero(size);
  }
  constexpr auto kTogether = static_cast<Index>(PackedMatrix::kTogether);
  moved_.setZero(kTogether * 6 * size);
  pulled_.setZero(kTogether * PackedMatrix(MatrixXd::Zero(2 * size, 1)).rows());
}

RotorWorkCell RotorWork::cell(const LinearRotor& rotor, double low, double high) const {
  struct Sample {
    MatrixXd acceleration, jerk, damping, circulatory, stiffness_slope, jerk_by_force;
  };
  const Index n = rotor.dof();
  const Index size = basis_.cols();
  const MatrixXd forces = allForces(phasorColumns(channels_, n), rotor.load, directions_);
  const auto sample = [&](double speed) {
    const Linearization l = rotor.matrices(speed);
    const Cholesky mass(l.mass);
    MatrixXd j(n, 2 * n);
    j << -mass.solve(l.stiffness + l.circulatory), -mass.solve(l.damping + l.gyroscopic);
    const MatrixXd by_rate = basis_.transpose() * j.rightCols(n);
    Sample s;
    s.acceleration = basis_.transpose() * j;
    s.jerk = by_rate * j;
    s.jerk.rightCols(n) += basis_.transpose() * j.leftCols(n);
    s.damping = basis_.transpose() * l.damping * basis_;
    s.circulatory = basis_.transpose() * l.circulatory * basis_;
    s.stiffness_slope = basis_.transpose() * stiffnessSlope(rotor, speed) * basis_;
    s.jerk_by_force = by_rate * mass.solve(forces);
    return s;
  };
  RotorWorkCell c;
  c.centre = 0.5 * (low + high);
  c.half_width = high > low ? 0.5 * (high - low) : 1.0;
  const Sample below = sample(c.centre - c.half_width);
  const Sample middle = sample(c.centre);
  const Sample above = sample(c.centre + c.half_width);
  const auto through = [&](auto part) { return parabola(below.*part, middle.*part, above.*part); };
  const Polynomial acceleration = through(&Sample::acceleration);
  const Polynomial jerk = through(&Sample::jerk);
  const Polynomial jerk_by_force = through(&Sample::jerk_by_force);

  const Index p = forces.cols();
  MatrixXd end = MatrixXd::Zero(4 * size, 10 * n + 4 * p);
  end.block(0, 0, size, n) = basis_.transpose();
  end.block(size, n, size, n) = h_ * basis_.transpose();
  const double h2 = h_ * h_;
  const double h3 = h2 * h_;
  for (Index k = 0; k < 3; ++k) {
    const auto term = static_cast<std::size_t>(k);
    end.block(2 * size, 2 * n * k, size, 2 * n) = h2 * acceleration[term];
    end.block(3 * size, 2 * n * k, size, 2 * n) = h3 * jerk[term];
    end.block(3 * size, 10 * n + p * k, size, p) = h3 * jerk_by_force[term];
  }
  end.block(3 * size, 6 * n, size, 2 * n) = h3 * acceleration[1];
  end.block(3 * size, 8 * n, size, 2 * n) = h3 * acceleration[2];
  end.block(2 * size, 10 * n, size, p) = h2 * acceleration_by_force_;
  end.block(3 * size, 10 * n + 3 * p, size, p) = h3 * acceleration_by_force_;
  c.end = PackedMatrix(end);

  const Polynomial damping = through(&Sample::damping);
  const Polynomial circulatory = through(&Sample::circulatory);
  const Polynomial stiffness_slope = through(&Sample::stiffness_slope);
  MatrixXd pulls = MatrixXd::Zero(2 * size, 6 * size);
  for (Index k = 0; k < 3; ++k) {
    const auto term = static_cast<std::size_t>(k);
    pulls.block(0, k * size, size, size) = damping[term];
    pulls.block(0, (3 + k) * size, size, size) = circulatory[term];
    pulls.block(size, (3 + k) * size, size, size) = stiffness_slope[term];
  }
  c.forces = PackedMatrix(pulls);
  return c;
}

}  // namespace whirl_twin
