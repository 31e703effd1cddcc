#include "integration/applied_inputs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace whirl_twin {

using Eigen::Index;

AppliedInputs::AppliedInputs(const Inputs* inputs, const Eigen::MatrixXd& directions,
                             const Eigen::MatrixXd& pushes)
    : inputs_(inputs),
      directions_(directions.rows(), 0),
      pushes_(static_cast<std::size_t>(pushes.cols())) {
  if (inputs != nullptr) {
    takeInputs(*inputs, directions);
  }
  for (Index k = 0; k < pushes.cols(); ++k) {
    channels_.push_back({kPush, false, 0.0, 0.0, 0.0, 0.0, {}, {}});
    directions_.conservativeResize(Eigen::NoChange, directions_.cols() + 1);
    directions_.rightCols(1) = pushes.col(k);
  }
}

void AppliedInputs::takeInputs(const Inputs& inputs, const Eigen::MatrixXd& directions) {
  if (static_cast<Index>(inputs.count()) != directions.cols()) {
    throw std::logic_error("a system has been given inputs that its model does not have");
  }
  for (std::size_t i = 0; i < inputs.count(); ++i) {
    if (inputs.acts(i)) {
      const InputSignal& signal = inputs.signal(i);
      channels_.push_back(
          {i, inputs.isHarmonic(i), signal.amplitude, signal.frequency, signal.pole, 0.0, {}, {}});
      directions_.conservativeResize(Eigen::NoChange, directions_.cols() + 1);
      directions_.rightCols(1) = directions.col(static_cast<Index>(i));
      tables_ = tables_ || inputs.isTable(i);
    }
  }
}

Eigen::Matrix2d AppliedInputs::generator(Index k, double unit) const {
  const double w = channel(k).frequency;
  Eigen::Matrix2d g;
  if (isHarmonic(k)) {
    g << 0.0, -w, w, 0.0;
  } else {
    g << 0.0, 1.0 / unit, 0.0, -channel(k).pole;
  }
  return g;
}

void AppliedInputs::writePairs(double offset, std::int64_t piece, double unit,
                               double* out) const noexcept {
  for (const Channel& c : channels_) {
    if (c.harmonic) {
      const double phase = inputs_->phase(c.input) + c.frequency * offset;
      *out++ = c.amplitude * std::cos(phase);
      *out++ = c.amplitude * std::sin(phase);
    } else {
      const SignalPiece line = inputs_->piece(c.input, piece);
      *out++ = line.at(offset);
      *out++ = line.slopeAt(offset) * unit;
    }
  }
}

void AppliedInputs::follow(double offset, double h) noexcept {
  h_ = h;
  offset_ = offset;
  for (Channel& c : channels_) {
    if (c.harmonic) {
      c.phase = inputs_->phase(c.input) + c.frequency * offset;
    } else if (c.pole > 0.0) {
      c.lag = inputs_->piece(c.input, 0);
    } else if (c.input != kPush) {
      project(c, offset);
    }
  }
}

/// Legendre coefficients, piece by piece with three Gauss nodes, exact for straight lines; then
/// powers of tau.
void AppliedInputs::project(Channel& c, double offset) const noexcept {
  constexpr std::array<double, 3> kNodes{0.11270166537925831148, 0.5, 0.88729833462074168852};
  constexpr std::array<double, 3> kWeights{5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
  constexpr double kSliverOfInput = 1e-3;  // ns
  const double start = offset * 1e9;
  const double end = start + h_ * 1e9;
  auto piece = static_cast<std::int64_t>(std::floor(start + kSliverOfInput));
  const std::int64_t first = inputs_->nextCorner(piece);
  SignalPiece line = inputs_->piece(c.input, piece);
  if (static_cast<double>(first) >= end - kSliverOfInput) {
    c.course = {line.at(offset), line.slope * h_, 0.0, 0.0};
    return;
  }
  std::array<double, kDegree + 1> legendre{};
  double from = 0.0;
  while (from < 1.0) {
    const std::int64_t corner = inputs_->nextCorner(piece);
    const bool inside = static_cast<double>(corner) < end - kSliverOfInput;
    const double to = inside ? (static_cast<double>(corner) - start) / (end - start) : 1.0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      const double tau = from + kNodes[i] * (to - from);
      const double x = 2.0 * tau - 1.0;
      const double share = kWeights[i] * (to - from) * line.at(offset + tau * h_);
      legendre[0] += share;
      legendre[1] += 3.0 * share * x;
      legendre[2] += 5.0 * share * (1.5 * x * x - 0.5);
      legendre[3] += 7.0 * share * (2.5 * x * x - 1.5) * x;
    }
    from = to;
    if (inside) {
      piece = corner;
      line = inputs_->piece(c.input, piece);
    }
  }
  const auto [p0, p1, p2, p3] = legendre;
  c.course = {p0 - p1 + p2 - p3, 2.0 * p1 - 6.0 * p2 + 12.0 * p3, 6.0 * p2 - 30.0 * p3, 20.0 * p3};
}

void AppliedInputs::writeCourses(double* out) const noexcept {
  for (const Channel& c : channels_) {
    if (c.harmonic) {
      *out++ = c.amplitude * std::cos(c.phase);
      *out++ = c.amplitude * std::sin(c.phase);
    } else if (c.pole > 0.0) {
      *out++ = c.lag.at(offset_);
      *out++ = c.lag.slopeAt(offset_) * h_;
    } else {
      out = std::copy(c.course.begin(), c.course.end(), out);
    }
  }
}

double AppliedInputs::value(Index k, double tau) const noexcept {
  const Channel& c = channel(k);
  if (c.harmonic) {
    return c.amplitude * std::cos(c.phase + c.frequency * h_ * tau);
  }
  if (c.pole > 0.0) {
    return c.lag.at(offset_ + h_ * tau);
  }
  return c.course[0] + tau * (c.course[1] + tau * (c.course[2] + tau * c.course[3]));
}

double AppliedInputs::rate(Index k, double tau) const noexcept {
  const Channel& c = channel(k);
  if (c.harmonic) {
    return -c.amplitude * c.frequency * std::sin(c.phase + c.frequency * h_ * tau);
  }
  if (c.pole > 0.0) {
    return c.lag.slopeAt(offset_ + h_ * tau);
  }
  return (c.course[1] + tau * (2.0 * c.course[2] + tau * 3.0 * c.course[3])) / h_;
}

}  // namespace whirl_twin
