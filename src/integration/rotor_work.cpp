#include "integration/rotor_work.h"

#include <cmath>
#include <complex>

#include "integration/shaft_phasor.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

}  // namespace

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

void RotorWork::evaluate(RotorWorkCell& cell, const ShaftMotion& shaft, const AppliedInputs& acting,
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
                      const AppliedInputs& acting,
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

/// At a breakpoint of the profile the drive's acceleration jumps, and with it the second and third
/// derivative of z: the contribution of the jump is subtracted from the interpolant at the end, and
/// added back after the breakpoint.
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

/// z and z' of a node, as number `place` of those that are evaluated together.
void RotorWork::takeNode(const RotorWorkCell& cell, const ShaftNode& node, const Weights& weights,
                         double corner, std::size_t place) noexcept {
  constexpr std::size_t kTogether = PackedMatrix::kTogether;
  deflectionAt(node.tau, weights, corner);
  const double s = (node.shaft.speed - cell.centre) / cell.half_width;
  const auto size = static_cast<std::size_t>(z_.size());
  double* const moved = moved_.data() + place;
  for (std::size_t j = 0; j < size; ++j) {
    const auto at = static_cast<Index>(j);
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = k == 0 ? 1.0 : k == 1 ? s : s * s;
      moved[kTogether * (k * size + j)] = share * z_rate_[at];
      moved[kTogether * ((3 + k) * size + j)] = share * z_[at];
    }
  }
}

/// After takeNode() of it and RotorWorkCell::forces.
double RotorWork::power(const ShaftNode& node, const AppliedInputs& acting,
                        std::size_t place) noexcept {
  constexpr std::size_t kTogether = PackedMatrix::kTogether;
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
  const auto size = static_cast<std::size_t>(pull_.size());
  const double* const moved = moved_.data() + place;
  const double* const pulled = pulled_.data() + place;
  double watts = 0.0;
  double of_stiffness = 0.0;
  for (std::size_t j = 0; j < size; ++j) {
    watts += moved[kTogether * j] * (pull_[static_cast<Index>(j)] - pulled[kTogether * j]);
    of_stiffness += moved[kTogether * (3 * size + j)] * pulled[kTogether * (size + j)];
  }
  return watts + 0.5 * node.shaft.acceleration * of_stiffness;
}

template <class Shaft>
double RotorWork::work(RotorWorkCell& cell, const Shaft& drive, double offset,
                       const ShaftNodes& nodes, const AppliedInputs& acting,
                       const Eigen::Ref<const Eigen::VectorXd>& state) noexcept {
  if (basis_.cols() == 0) {
    return 0.0;
  }
  // The first breakpoint inside the step is resolved; at further ones the interpolant loses order.
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
  static_assert(PackedMatrix::kTogether == ShaftNodes::kNodes.size());
  double sum = 0.0;
  // Of a step, or of a sub-step up to a breakpoint.
  for (const ShaftNode* part = nodes.begin(); part != nodes.end(); part += weights_.size()) {
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      takeNode(cell, part[i], nodes.plain() ? weights_[i] : weightsAt(part[i].tau), corner, i);
    }
    cell.forces.multiplyTogether(moved_.data(), pulled_.data());
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      sum += part[i].weight * power(part[i], acting, i);
    }
  }
  return h_ * sum;
}

template void RotorWork::start(RotorWorkCell&, const Drive&, double, const AppliedInputs&,
                               const Eigen::Ref<const Eigen::VectorXd>&) noexcept;
template void RotorWork::start(RotorWorkCell&, const ShaftCourse&, double, const AppliedInputs&,
                               const Eigen::Ref<const Eigen::VectorXd>&) noexcept;
template double RotorWork::work(RotorWorkCell&, const Drive&, double, const ShaftNodes&,
                                const AppliedInputs&,
                                const Eigen::Ref<const Eigen::VectorXd>&) noexcept;
template double RotorWork::work(RotorWorkCell&, const ShaftCourse&, double, const ShaftNodes&,
                                const AppliedInputs&,
                                const Eigen::Ref<const Eigen::VectorXd>&) noexcept;

}  // namespace whirl_twin
