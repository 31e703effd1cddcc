// What a step of a linear rotor (rotor_step.h) is prepared of: its maps at constant speeds, and
// over the speed.
#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "integration/rotor_step.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kTableError = 1.0e-12;  // of a cell's map, relative to its largest entry
constexpr double kSmoothError = 0.1 * kTableError;  // of the interpolant that the cells are
                                                    // computed from
constexpr double kMaxRounding = 1.0e-9;
constexpr double kNoChange = 1.0e-15;
constexpr double kSlopeRounding = 1.0e-10;
constexpr double kMaxCells = 4096.0;

/// d(K+N, C+G)/dw at a speed; part by part, so that what does not change leaves no rounding.
MatrixXd forceSlope(const LinearRotor& rotor, double speed) {
  const double step = 1.0e-2 * std::max(1.0, std::fabs(speed));
  const Linearization above = rotor.matrices(speed + step);
  const Linearization below = rotor.matrices(speed - step);
  MatrixXd change(rotor.dof(), 2 * rotor.dof());
  change << (above.stiffness - below.stiffness) + (above.circulatory - below.circulatory),
      (above.damping - below.damping) + (above.gyroscopic - below.gyroscopic);
  return change / (2.0 * step);
}

void requireFinite(const MatrixXd& matrix) {
  if (!matrix.allFinite()) {
    throw RunFailure("the rotor's step exceeds the range of doubles: shorten the step");
  }
}

}  // namespace

RotorStep::RotorStep(const LinearRotor& rotor, double h, const std::pair<double, double>& speeds,
                     const std::vector<double>& constant_speeds, const AppliedInputs& acting,
                     AuditedWork audited)
    : n_(rotor.dof()), h_(h), channels_(forceChannels(rotor)), acting_(acting), audited_(audited) {
  for (const double speed : constant_speeds) {
    const RotorMap map(rotor, channels_, acting_, speed, h, 0);
    const MatrixXd increment = map.increment();
    const MatrixXd work = map.work();
    requireFinite(increment);
    requireFinite(work);
    constant_.push_back({speed, stepMatrix(increment, work), {}});
    if (acting_.haveTables()) {
      for (const RotorStepMatrices& part : map.parts()) {
        constant_.back().parts.push_back(stepMatrix(part.increment, part.work));
      }
    }
  }
  work_ = RotorWork(rotor, channels_, acting_, h, speeds, audited == AuditedWork::kAll);
  by_form_ =
      audited != AuditedWork::kNone && acting_.arePushed() && !stiffnessChanges(rotor, speeds);
  boundaries_ = {speeds.first};
  if (speeds.second > speeds.first) {
    prepare(rotor, speeds);
  } else {
    boundaries_.push_back(speeds.second);
  }
  const Index inputs = tableInputs();
  y_.setZero(std::max(inputs, RotorMap::inputs(n_, channels_.size(), acting_, 0)));
  powers_.setZero(inputs * (kDegree + 1));
  result_.setZero(PackedMatrix(MatrixXd::Zero(2 * n_ + y_.size(), 1)).rows());
  shear_.setZero(PackedMatrix(MatrixXd::Zero(n_, 1)).rows());
  increment_.setZero(2 * n_);
  rates_.setZero(n_);
}

void RotorStep::prepare(const LinearRotor& rotor, const std::pair<double, double>& speeds) {
  std::vector<double> ends{speeds.first};
  for (const double knot : rotor.knots) {
    if (knot > speeds.first && knot < speeds.second) {
      ends.push_back(knot);
    }
  }
  ends.push_back(speeds.second);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const MapOverSpeed map([&](double speed) { return tableMap(rotor, speed); }, ends[i],
                           ends[i + 1],
                           [this](const MatrixXd& error, const MatrixXd& exact) {
                             return relativeError(error, exact);
                           },
                           kSmoothError, kMaxRounding);
    // Narrow enough at both ends of a stretch of smooth matrices: narrow enough throughout.
    const double range = ends[i + 1] - ends[i];
    double count = 1.0;
    double before = kInfinity;
    while (true) {
      const double width = range / count;
      const double error = std::max(cubicError(map, ends[i], ends[i] + width),
                                    cubicError(map, ends[i + 1] - width, ends[i + 1]));
      // What no longer falls is the rounding of a very stiff rotor's map.
      const bool rounding = error < kMaxRounding && error > 0.5 * before;
      if (error <= kTableError || rounding) {
        break;
      }
      count *= std::clamp(std::pow(error / kTableError, 0.25), 1.5, 8.0);
      before = error;
      if (count + static_cast<double>(cells_.size()) > kMaxCells) {
        throw RunFailure(
            "the rotor's matrices change too fast with speed for its step: shorten the step");
      }
    }
    count = std::ceil(count);
    for (double k = 0.0; k < count; k += 1.0) {
      const double high = k + 1.0 == count ? ends[i + 1] : ends[i] + range * (k + 1.0) / count;
      cells_.push_back(cell(rotor, map, boundaries_.back(), high));
      boundaries_.push_back(high);
    }
  }
}

Index RotorStep::tableInputs() const {
  return RotorMap::inputs(n_, channels_.size(), acting_, kDegree);
}

/// The increments and below them, where the work is computed from it, the upper triangle of W.
MatrixXd RotorStep::tableMap(const LinearRotor& rotor, double speed) const {
  const RotorMap map(rotor, channels_, acting_, speed, h_, kDegree);
  return by_form_ ? stackedStep(map.increment(), map.work(audited_ == AuditedWork::kAll))
                  : map.increment();
}

/// Whether K depends on the speed. Then the change of its energy is additional work.
bool RotorStep::stiffnessChanges(const LinearRotor& rotor,
                                 const std::pair<double, double>& speeds) const {
  const MatrixXd first = rotor.matrices(speeds.first).stiffness;
  const double rounding = kTableError * first.cwiseAbs().maxCoeff();
  for (const double share : {0.3, 0.7, 1.0}) {
    const double speed = speeds.first + share * (speeds.second - speeds.first);
    if ((rotor.matrices(speed).stiffness - first).cwiseAbs().maxCoeff() > rounding) {
      return true;
    }
  }
  return false;
}

/// The map as a cubic in s: its coefficients side by side.
MatrixXd RotorStep::cubic(const MapOverSpeed& map, double low, double high) const {
  Eigen::Matrix4d powers;
  std::array<MatrixXd, 4> at;
  for (int i = 0; i < 4; ++i) {
    const double s = std::cos((2 * i + 1) * kPi / 8.0);
    powers.row(i) << 1.0, s, s * s, s * s * s;
    at[static_cast<std::size_t>(i)] = map.at(0.5 * (low + high) + 0.5 * s * (high - low));
  }
  const MatrixXd coefficients = Lu(powers).inverse();
  const Index inputs = tableInputs();
  MatrixXd all = MatrixXd::Zero(at[0].rows(), 4 * inputs);
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 4; ++i) {
      all.middleCols(k * inputs, inputs) += coefficients(k, i) * at[static_cast<std::size_t>(i)];
    }
  }
  requireFinite(all);
  // What does not follow the speed has rounding there, which costs as much as numbers do.
  for (Index j = inputs; j < 4 * inputs; ++j) {
    for (const Index rows : {Index{0}, n_}) {
      const auto constant = all.col(j % inputs).segment(rows, n_);
      auto change = all.col(j).segment(rows, n_);
      if (change.cwiseAbs().maxCoeff() <= kNoChange * constant.cwiseAbs().maxCoeff()) {
        change.setZero();
      }
    }
  }
  return all;
}

/// In the middle of a cell the cubic through the Chebyshev nodes is off by most.
double RotorStep::cubicError(const MapOverSpeed& map, double low, double high) const {
  const MatrixXd exact = map.at(0.5 * (low + high));
  return relativeError(cubic(map, low, high).leftCols(tableInputs()) - exact, exact);
}

/// Positions and rates have their own sizes, and so has each input.
double RotorStep::relativeError(const MatrixXd& error, const MatrixXd& exact) const {
  double largest = 0.0;
  for (Index j = 0; j < exact.cols(); ++j) {
    for (const Index rows : {Index{0}, n_}) {
      const double off = error.col(j).segment(rows, n_).cwiseAbs().maxCoeff();
      const double size = exact.col(j).segment(rows, n_).cwiseAbs().maxCoeff();
      const bool of_itself = j < 2 * n_ && (j < n_) == (rows == 0);
      if (off > 0.0) {
        largest = std::max(largest, off / (size + (of_itself ? 1.0 : 0.0)));
      }
    }
  }
  return largest;
}

RotorStep::Cell RotorStep::cell(const LinearRotor& rotor, const MapOverSpeed& map, double low,
                                double high) const {
  Cell c;
  c.centre = 0.5 * (low + high);
  c.half_width = 0.5 * (high - low);
  c.increment = PackedMatrix(cubic(map, low, high));
  if (rotor.speed_dependent) {
    const Cholesky mass(rotor.matrices(low).mass);
    const MatrixXd below = -mass.solve(forceSlope(rotor, low));
    const MatrixXd above = -mass.solve(forceSlope(rotor, high));
    MatrixXd slope(n_, 4 * n_);
    slope << 0.5 * (above - below), 0.5 * (below + above);
    const auto largest = [&](Index half) {
      return slope.middleCols(2 * n_ * half, 2 * n_).cwiseAbs().maxCoeff();
    };
    if (largest(0) <= kSlopeRounding * largest(1)) {
      slope.leftCols(2 * n_).setZero();
    }
    if ((slope.array() != 0.0).any()) {
      c.slope = PackedMatrix(slope);
    }
  }
  if (!by_form_ && audited_ != AuditedWork::kNone) {
    c.work = work_.cell(rotor, low, high);
  }
  return c;
}

}  // namespace whirl_twin
