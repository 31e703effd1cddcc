#include "integration/rotor_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "integration/shaft_phasor.h"
#include "integration/sliver.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

}  // namespace

StepStatus RotorStep::advance(const Drive& drive, double offset, LinearMotion& motion) noexcept {
  if (drive.constantFor(offset + h_)) {
    const ShaftMotion shaft = drive.at(offset);
    if (ConstantSpeed* const constant = constantAt(shaft.speed)) {
      const std::int64_t piece = acting_.count() > 0 ? wholeNanoseconds(offset) : 0;
      constantStep(constant->map, shaft, offset, piece, motion);
      return StepStatus::kOk;
    }
  }
  Cell* const cell = cellOf(drive, offset);
  if (cell == nullptr) {
    return StepStatus::kOutOfRange;
  }
  if (!by_form_) {
    work_.start(cell->work, drive, offset, acting_, motion.state);
  }
  changingStep(*cell, motion);
  motion.advance(increment_.data(), by_form_ ? form_work_
                                             : work_.work(cell->work, drive, offset, nodes_,
                                                          acting_, y_.head(2 * n_)));
  return StepStatus::kOk;
}

template <class Shaft>
StepStatus RotorStep::move(const Shaft& drive, double offset, LinearMotion& motion) noexcept {
  Cell* const cell = cellOf(drive, offset);
  if (cell == nullptr) {
    return StepStatus::kOutOfRange;
  }
  changingStep(*cell, motion);
  motion.advance(increment_.data(), 0.0);
  return StepStatus::kOk;
}

template <class Shaft>
double RotorStep::work(const Shaft& drive, double offset, const Eigen::VectorXd& from,
                       const Eigen::VectorXd& to) noexcept {
  if (by_form_) {
    return form_work_;
  }
  Cell* const cell = cellAt(nodes_.meanSpeed());
  work_.start(cell->work, drive, offset, acting_, from);
  return work_.work(cell->work, drive, offset, nodes_, acting_, to);
}

/// Takes up the motion of the shaft and the inputs over a step; nullptr: there is no cell for it.
template <class Shaft>
RotorStep::Cell* RotorStep::cellOf(const Shaft& drive, double offset) noexcept {
  nodes_.sample(drive, offset, h_);
  acting_.follow(offset, h_);
  return cellAt(nodes_.meanSpeed());
}

RotorStep::Cell* RotorStep::cellAt(double speed) noexcept {
  // A speed held at the edge may lie beyond it by rounding.
  const double sliver = 1.0e-9 * (1.0 + std::fabs(speed));
  if (cells_.empty() || !(speed >= boundaries_.front() - sliver) ||
      !(speed <= boundaries_.back() + sliver)) {
    return nullptr;
  }
  const auto above = std::upper_bound(boundaries_.begin() + 1, boundaries_.end() - 1, speed);
  return &cells_[static_cast<std::size_t>(above - boundaries_.begin()) - 1];
}

bool RotorStep::advanceInParts(const Drive& drive, std::int64_t from, std::int64_t to,
                               LinearMotion& motion) noexcept {
  const auto seconds = [](std::int64_t nanoseconds) {
    return static_cast<double>(nanoseconds) / 1e9;
  };
  if (!drive.constantFor(seconds(to))) {
    return false;
  }
  ConstantSpeed* const constant = constantAt(drive.at(seconds(from)).speed);
  if (constant == nullptr || constant->parts.empty()) {
    return false;
  }
  while (from < to) {
    const std::int64_t corner = std::min(acting_.nextCorner(from), to);
    const std::int64_t piece = from;
    for (std::size_t k = constant->parts.size(); k-- > 0;) {
      for (; corner - from >= std::int64_t{1} << k; from += std::int64_t{1} << k) {
        const double offset = seconds(from);
        constantStep(constant->parts[k], drive.at(offset), offset, piece, motion);
      }
    }
  }
  return true;
}

/// nullptr: none is prepared.
RotorStep::ConstantSpeed* RotorStep::constantAt(double speed) noexcept {
  for (ConstantSpeed& constant : constant_) {
    if (constant.speed == speed) {
      return &constant;
    }
  }
  return nullptr;
}

const double* RotorStep::constantStart(const Drive& drive, double offset,
                                       const LinearMotion& motion, std::size_t& which) noexcept {
  if (!drive.constantFor(offset + h_)) {
    return nullptr;
  }
  const ShaftMotion shaft = drive.at(offset);
  const ConstantSpeed* const constant = constantAt(shaft.speed);
  if (constant == nullptr) {
    return nullptr;
  }
  which = static_cast<std::size_t>(constant - constant_.data());
  startOf(shaft, offset, wholeNanoseconds(offset), motion);
  return y_.data();
}

/// Fills y_ and returns the number of entries.
Index RotorStep::startOf(const ShaftMotion& shaft, double offset, std::int64_t piece,
                         const LinearMotion& motion) noexcept {
  y_.head(2 * n_) = motion.state;
  Index input = 2 * n_;
  for (const ForceChannel& channel : channels_) {
    const double size = channel.inertial ? shaft.speed * shaft.speed : 1.0;
    const double angle = channel.harmonic * shaft.angle;
    const double cosine = std::cos(angle);  // both together cost little more than one
    const double sine = std::sin(angle);
    y_[input++] = size * cosine;
    y_[input++] = size * sine;
  }
  y_[input++] = 1.0;
  if (acting_.arePushed()) {
    acting_.follow(offset, h_);
    acting_.writeCourses(y_.data() + input);
    input = RotorMap::inputs(n_, channels_.size(), acting_, 0);
  } else if (acting_.count() > 0) {
    acting_.writePairs(offset, piece, h_, y_.data() + input);
    input += 2 * acting_.count();
  }
  return input;
}

void RotorStep::constantStep(PackedMatrix& map, const ShaftMotion& shaft, double offset,
                             std::int64_t piece, LinearMotion& motion) noexcept {
  work_.restart();
  const Index input = startOf(shaft, offset, piece, motion);
  map.multiply(y_.data(), result_.data());
  motion.advance(result_.data(), y_.head(input).dot(result_.segment(2 * n_, input)));
}

/// Fills the inputs from 2 n on with the coefficients of g.
void RotorStep::project() noexcept {
  auto coefficients = y_.segment(2 * n_, tableInputs() - 2 * n_);
  coefficients.setZero();
  for (const ShaftNode& node : nodes_) {
    const double x = 2.0 * node.tau - 1.0;
    const std::array<double, kDegree + 1> legendre{node.weight, 3.0 * node.weight * x,
                                                   5.0 * node.weight * (1.5 * x * x - 0.5),
                                                   7.0 * node.weight * (2.5 * x * x - 1.5) * x};
    double* coefficient = coefficients.data();
    for (const ForceChannel& channel : channels_) {
      Complex g = smallTurn(channel.harmonic * node.lead);
      if (channel.inertial) {
        g *= Complex(node.shaft.speed * node.shaft.speed, -node.shaft.acceleration);
      }
      for (const double share : legendre) {
        *coefficient++ += share * g.real();
        *coefficient++ += share * g.imag();
      }
    }
  }
  Index input = 0;
  for (const ForceChannel& channel : channels_) {
    const Complex turn = std::pow(nodes_.startTurn(), channel.harmonic);
    std::array<Complex, kDegree + 1> p;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Index at = input + 2 * static_cast<Index>(k);
      p[k] = turn * Complex(coefficients[at], coefficients[at + 1]);
    }
    // Legendre polynomials of 2 tau - 1 as powers of tau.
    const std::array<Complex, kDegree + 1> powers{p[0] - p[1] + p[2] - p[3],
                                                  2.0 * p[1] - 6.0 * p[2] + 12.0 * p[3],
                                                  6.0 * p[2] - 30.0 * p[3], 20.0 * p[3]};
    for (const Complex& g : powers) {
      coefficients[input++] = g.real();
      coefficients[input++] = g.imag();
    }
  }
  coefficients[input++] = 1.0;
  acting_.writeCourses(coefficients.data() + input);
}

/// e A'(q, v), for the state in y_ with other rates.
void RotorStep::shear(Cell& cell, double s, double e, const double* rates) noexcept {
  powers_.segment(2 * n_, n_) = y_.head(n_);
  powers_.segment(3 * n_, n_) = Eigen::Map<const Eigen::VectorXd>(rates, n_);
  powers_.head(2 * n_) = s * powers_.segment(2 * n_, 2 * n_);
  cell.slope.multiply(powers_.data(), shear_.data());
  shear_ *= e;
}

/// From a motion to y_, by increment_.
void RotorStep::changingStep(Cell& cell, const LinearMotion& motion) noexcept {
  y_.head(2 * n_) = motion.state;
  increment_.setZero();
  project();
  const double e = nodes_.meanLead();
  const double s = (nodes_.meanSpeed() - cell.centre) / cell.half_width;
  const bool sheared = cell.slope.rows() > 0;
  if (sheared) {
    shear(cell, s, e, y_.data() + n_);
    y_.segment(n_, n_) += shear_.head(n_);
    increment_.tail(n_) = shear_.head(n_);
  }
  const Index inputs = tableInputs();
  powers_.head(inputs) = y_.head(inputs);
  for (int k = 1; k <= kDegree; ++k) {
    powers_.segment(k * inputs, inputs) = s * powers_.segment((k - 1) * inputs, inputs);
  }
  cell.increment.multiply(powers_.data(), result_.data());
  form_work_ = by_form_ ? y_.head(inputs).dot(result_.segment(2 * n_, inputs)) : 0.0;
  increment_ += result_.head(2 * n_);
  y_.head(2 * n_) += result_.head(2 * n_);
  if (sheared) {
    // Its inverse, by two iterations: the residual is of order e^3; one of e^2 would accumulate.
    shear(cell, s, e, y_.data() + n_);
    rates_ = y_.segment(n_, n_) - shear_.head(n_);
    shear(cell, s, e, rates_.data());
    y_.segment(n_, n_) -= shear_.head(n_);
    increment_.tail(n_) -= shear_.head(n_);
  }
}

template StepStatus RotorStep::move(const Drive&, double, LinearMotion&) noexcept;
template StepStatus RotorStep::move(const ShaftCourse&, double, LinearMotion&) noexcept;
template double RotorStep::work(const Drive&, double, const Eigen::VectorXd&,
                                const Eigen::VectorXd&) noexcept;
template double RotorStep::work(const ShaftCourse&, double, const Eigen::VectorXd&,
                                const Eigen::VectorXd&) noexcept;

}  // namespace whirl_twin
