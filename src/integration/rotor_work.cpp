#include "integration/rotor_work.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/cholesky.h"
#include "algebra/lu.h"
#include "algebra/qr.h"
#include "integration/shaft_course.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Polynomial = RotorWorkCell::Polynomial;

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
  Eigen::ColPivHouseholderQR<MatrixXd> qr(all);
  qr.setThreshold(kIndependent);
  return MatrixXd(qr.householderQ()).leftCols(qr.rank());
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

/// Number of its powers up to the last that is not zero.
std::size_t terms(const Polynomial& p) {
  std::size_t count = p.size();
  while (count > 0 && (p[count - 1].array() == 0.0).all()) {
    --count;
  }
  return count;
}

}  // namespace

RotorWork::RotorWork(const LinearRotor& rotor, const std::vector<ForceChannel>& channels,
                     const ActingInputs& acting, double h, const std::pair<double, double>& speeds,
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
  const Eigen::LLT<MatrixXd> mass(rotor.matrices(speeds.first).mass);
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
  hermite_ = ends.inverse().transpose();
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
    const Eigen::LLT<MatrixXd> mass(l.mass);
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

  c.damping = through(&Sample::damping);
  c.circulatory = through(&Sample::circulatory);
  c.stiffness_slope = through(&Sample::stiffness_slope);
  c.damping_terms = terms(c.damping);
  c.circulatory_terms = terms(c.circulatory);
  c.stiffness_slope_terms = terms(c.stiffness_slope);
  return c;
}

Index RotorWork::phasorCount() const noexcept {
  return 2 * static_cast<Index>(channels_.size()) + 1;
}

/// The phasors and 1, and their rates.
void RotorWork::setPhasors(const ShaftMotion& shaft, double* phasors,
                           double* rates) const noexcept {
  for (const ForceChannel& channel : channels_) {
    const double m = channel.harmonic;
    const Complex turn(std::cos(m * shaft.angle), std::sin(m * shaft.angle));
    Complex factor = 1.0;
    Complex change = 0.0;
    if (channel.inertial) {
      factor = {shaft.speed * shaft.speed, -shaft.acceleration};
      change = {2.0 * shaft.speed * shaft.acceleration, -shaft.jerk};
    }
    const Complex value = factor * turn;
    const Complex rate = (change + Complex(0.0, m * shaft.speed) * factor) * turn;
    *phasors++ = value.real();
    *phasors++ = value.imag();
    *rates++ = rate.real();
    *rates++ = rate.imag();
  }
  *phasors = 1.0;
  *rates = 0.0;
}

void RotorWork::evaluate(RotorWorkCell& cell, const ShaftMotion& shaft, const ActingInputs& acting,
                         double tau, const Eigen::Ref<const Eigen::VectorXd>& state,
                         Eigen::VectorXd& end) noexcept {
  const Index n2 = state.size();
  const Index p = phasors_.size();
  const double s = (shaft.speed - cell.centre) / cell.half_width;
  const double a = shaft.acceleration / cell.half_width;
  inputs_.head(n2) = state;
  inputs_.segment(n2, n2) = s * state;
  inputs_.segment(2 * n2, n2) = s * s * state;
  inputs_.segment(3 * n2, n2) = a * state;
  inputs_.segment(4 * n2, n2) = 2.0 * s * a * state;
  double* const phasors = inputs_.data() + 5 * n2;
  setPhasors(shaft, phasors, phasors + 3 * p);
  for (Index k = 0; k < acting.count(); ++k) {
    phasors[phasorCount() + k] = acting.value(k, tau);
    phasors[3 * p + phasorCount() + k] = acting.rate(k, tau);
  }
  for (Index i = 0; i < p; ++i) {
    phasors[p + i] = s * phasors[i];
    phasors[2 * p + i] = s * s * phasors[i];
  }
  cell.end.multiply(inputs_.data(), end.data());
}

template <class Shaft>
void RotorWork::start(RotorWorkCell& cell, const Shaft& drive, double offset,
                      const ActingInputs& acting,
                      const Eigen::Ref<const Eigen::VectorXd>& state) noexcept {
  const double hair = ShaftNodes::kSliver * h_;
  const bool corner = drive.nextCorner(offset) - offset < hair;
  const ShaftMotion shaft = drive.at(corner ? offset + 2.0 * hair : offset);
  const auto same = [](double a, double b) { return std::fabs(a - b) <= 1.0e-9 * std::fabs(b); };
  // An input may have jumped since.
  if (continued_ && acting.count() == 0 && same(shaft.acceleration, last_acceleration_) &&
      same(shaft.jerk, last_jerk_)) {
    from_.swap(to_);
    return;
  }
  evaluate(cell, shaft, acting, 0.0, state, from_);
}

/// Where the profile has a corner the drive's acceleration jumps, and with it the second and third
/// derivative of z: what grows from the jump until the end is taken from the interpolant, and put
/// back behind the corner.
template <class Shaft>
void RotorWork::takeJump(const Shaft& drive, double offset, double corner) noexcept {
  const Index size = basis_.cols();
  const double hair = ShaftNodes::kSliver;
  jump_.setZero();
  for (const double side : {-1.0, 1.0}) {
    setPhasors(drive.at(offset + (corner + side * hair) * h_), phasors_.data(), rates_.data());
    for (Index k = 0; k < phasorCount(); ++k) {
      jump_.head(size) += side * h_ * h_ * phasors_[k] * acceleration_by_force_.col(k);
      jump_.tail(size) += side * h_ * h_ * h_ * rates_[k] * acceleration_by_force_.col(k);
    }
  }
  const double d = 1.0 - corner;
  to_.head(size) -= 0.5 * d * d * jump_.head(size) + d * d * d / 6.0 * jump_.tail(size);
  to_.segment(size, size) -= d * jump_.head(size) + 0.5 * d * d * jump_.tail(size);
  to_.segment(2 * size, size) -= jump_.head(size) + d * jump_.tail(size);
  to_.segment(3 * size, size) -= jump_.tail(size);
}

/// Weights of the data at the ends for z and h z' at tau.
RotorWork::Weights RotorWork::weightsAt(double tau) const noexcept {
  Eigen::Matrix<double, 8, 2> powers;
  powers.row(0) << 1.0, 0.0;
  for (int k = 1; k < 8; ++k) {
    powers.row(k) << tau * powers(k - 1, 0), k * powers(k - 1, 0);
  }
  return hermite_ * powers;
}

/// z and z' inside the step.
void RotorWork::deflectionAt(double tau, const Weights& weights, double corner) noexcept {
  const Index size = basis_.cols();
  z_.setZero();
  z_rate_.setZero();
  for (Index d = 0; d < 4; ++d) {
    const auto from = from_.segment(d * size, size);
    const auto to = to_.segment(d * size, size);
    z_ += weights(d, 0) * from + weights(4 + d, 0) * to;
    z_rate_ += weights(d, 1) * from + weights(4 + d, 1) * to;
  }
  if (tau > corner) {
    const double d = tau - corner;
    z_ += 0.5 * d * d * jump_.head(size) + d * d * d / 6.0 * jump_.tail(size);
    z_rate_ += d * jump_.head(size) + 0.5 * d * d * jump_.tail(size);
  }
  z_rate_ /= h_;
}

double RotorWork::power(RotorWorkCell& cell, const ShaftNode& node,
                        const ActingInputs& acting) noexcept {
  const double s = (node.shaft.speed - cell.centre) / cell.half_width;
  pull_.setZero();
  Index column = 0;
  for (const ForceChannel& channel : channels_) {
    if (!driven_) {
      break;
    }
    Complex value = node.turn;
    for (int m = 1; m < std::abs(channel.harmonic); ++m) {
      value *= node.turn;
    }
    value = channel.harmonic == 0 ? 1.0 : channel.harmonic < 0 ? std::conj(value) : value;
    if (channel.inertial) {
      value *= Complex(node.shaft.speed * node.shaft.speed, -node.shaft.acceleration);
    }
    pull_ += value.real() * force_.col(column) + value.imag() * force_.col(column + 1);
    column += 2;
  }
  column = 2 * static_cast<Index>(channels_.size());
  for (Index k = 0; k < acting.count(); ++k) {
    pull_ += acting.value(k, node.tau) * force_.col(column + k);
  }
  double watts = 0.0;
  double share = 1.0;
  for (std::size_t k = 0; k < 3; ++k, share *= s) {
    for (Index j = 0; k < cell.damping_terms && j < z_.size(); ++j) {
      pull_ -= share * z_rate_[j] * cell.damping[k].col(j);
    }
    for (Index j = 0; k < cell.circulatory_terms && j < z_.size(); ++j) {
      pull_ -= share * z_[j] * cell.circulatory[k].col(j);
    }
    for (Index j = 0; k < cell.stiffness_slope_terms && j < z_.size(); ++j) {
      watts +=
          0.5 * node.shaft.acceleration * share * z_[j] * z_.dot(cell.stiffness_slope[k].col(j));
    }
  }
  return watts + z_rate_.dot(pull_);
}

template <class Shaft>
double RotorWork::work(RotorWorkCell& cell, const Shaft& drive, double offset,
                       const ShaftNodes& nodes, const ActingInputs& acting,
                       const Eigen::Ref<const Eigen::VectorXd>& state) noexcept {
  if (basis_.cols() == 0) {
    return 0.0;
  }
  // The first corner inside the step is followed; at further ones the interpolant loses order.
  const double corner = nodes.firstCorner();
  const double hair = ShaftNodes::kSliver;
  const double next = (drive.nextCorner(offset + (1.0 - 2.0 * hair) * h_) - offset) / h_;
  const ShaftMotion end = drive.at(offset + (next < 1.0 + hair ? 1.0 - 4.0 * hair : 1.0) * h_);
  evaluate(cell, end, acting, 1.0, state, to_);
  if (corner < 1.0) {
    takeJump(drive, offset, corner);
  }
  continued_ = corner == 1.0;
  last_acceleration_ = end.acceleration;
  last_jerk_ = end.jerk;
  double sum = 0.0;
  const Weights* plain = weights_.data();
  for (const ShaftNode& node : nodes) {
    deflectionAt(node.tau, nodes.plain() ? *plain++ : weightsAt(node.tau), corner);
    sum += node.weight * power(cell, node, acting);
  }
  return h_ * sum;
}

template void RotorWork::start(RotorWorkCell&, const Drive&, double, const ActingInputs&,
                               const Eigen::Ref<const Eigen::VectorXd>&) noexcept;
template void RotorWork::start(RotorWorkCell&, const ShaftCourse&, double, const ActingInputs&,
                               const Eigen::Ref<const Eigen::VectorXd>&) noexcept;
template double RotorWork::work(RotorWorkCell&, const Drive&, double, const ShaftNodes&,
                                const ActingInputs&,
                                const Eigen::Ref<const Eigen::VectorXd>&) noexcept;
template double RotorWork::work(RotorWorkCell&, const ShaftCourse&, double, const ShaftNodes&,
                                const ActingInputs&,
                                const Eigen::Ref<const Eigen::VectorXd>&) noexcept;

}  // namespace whirl_twin
