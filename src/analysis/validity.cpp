#include "analysis/validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "analysis/equilibria.h"
#include "analysis/natural_modes.h"
#include "analysis/orbit.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr int kPlaces = 32;                // of a cycle
constexpr double kSmallest = 1.0e-7;       // of the widest
constexpr double kAmplitudeStride = 1.25;  // from one amplitude to the next
constexpr int kHalvings = 20;              // of the last stride
constexpr double kVibrates = 1.0e-9;   // of the fastest motion: what turns more slowly is at rest
constexpr double kParted = 1.0e-10;    // of the shapes, as a matrix: beyond it two modes are one
constexpr double kNoDecrement = 1e-6;  // differences below it are none

/// A mode about a steady motion.
struct Mode {
  Complex root;  ///< [1/s]
  VectorXcd shape, adjoint;
};

std::optional<Mode> leastDamped(const Dynamics& mean, const SteadyMotion& motion, double speed) {
  const Linearization l = linearizationAbout(mean, motion.q, motion.v, speed);
  const Index n = l.mass.rows();
  const Lu mass(l.mass);
  MatrixXd state = MatrixXd::Zero(2 * n, 2 * n);
  state.topRightCorner(n, n).setIdentity();
  state.bottomLeftCorner(n, n) = -mass.solve(l.stiffness + l.circulatory);
  state.bottomRightCorner(n, n) = -mass.solve(l.damping + l.gyroscopic);
  if (!state.allFinite()) {
    return std::nullopt;
  }
  const EigenPairs solver = eigenPairs(state);
  const VectorXcd& roots = solver.values;
  const double fastest = roots.cwiseAbs().maxCoeff();
  Index least = -1;
  const auto damping = [&](Index i) { return -roots[i].real() / std::abs(roots[i]); };
  for (Index i = 0; i < roots.size(); ++i) {
    if (roots[i].imag() > kVibrates * fastest && (least < 0 || damping(i) < damping(least))) {
      least = i;
    }
  }
  if (least < 0) {
    return std::nullopt;
  }
  // To the left, orthogonal to every other mode's shape.
  const VectorXcd shape = solver.vectors.col(least);
  const ComplexLu shapes(solver.vectors.transpose());
  if (!(shapes.rcond() > kParted)) {
    return std::nullopt;
  }
  const VectorXcd adjoint = shapes.solve(VectorXcd::Unit(2 * n, least));
  return Mode{roots[least], shape, adjoint};
}

/// How wide the shape is.
struct Width {
  std::string coordinate;  ///< in which
  double of_shape = 0.0;
  double widest = 0.0;  ///< [rad] or [m], search limit
};

Width widthOf(const Dynamics& dynamics, const VectorXcd& shape) {
  const VectorXcd q = shape.head(dynamics.dof());
  const double length = dynamics.naturalLength();
  if (dynamics.isRotor()) {
    const Station station = dynamics.stations().front();
    const auto along = [&](const VectorXd& axis) { return (axis.transpose() * q).value(); };
    return {"whirl", Orbit(along(station.along_x), along(station.along_y)).major(), length};
  }
  const std::vector<CoordinateInfo> all = dynamics.coordinates();
  Width width;
  double most = -1.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double unit = all[i].isAngle() ? 1.0 : length;
    const double size = std::abs(q[static_cast<Index>(i)]);
    if (size / unit > most) {
      most = size / unit;
      width = {all[i].name, size, all[i].isAngle() ? kPi : length};
    }
  }
  return width;
}

}  // namespace

std::optional<LinearDampingLimit> linearDampingLimit(const Dynamics& dynamics,
                                                     const SteadyMotion& motion, double speed) {
  if (timeDependence(dynamics, speed).period) {
    return std::nullopt;  // no mode of the mean loads decays as the motion does
  }
  const Dynamics& mean = dynamics.atMeanLoad();
  const std::optional<Mode> mode = leastDamped(mean, motion, speed);
  if (!mode) {
    return std::nullopt;
  }
  const Width width = widthOf(dynamics, mode->shape);
  LinearDampingLimit found{std::numeric_limits<double>::infinity(), width.coordinate};
  if (dynamics.linear() || !(width.of_shape > 0.0)) {
    return found;
  }
  const Index n = mean.dof();
  const EvaluationPoint<double> at{0.0, 0.0, speed, 0.0};
  const VectorXd rest = mean.acceleration(motion.q, motion.v, at);
  const auto decrementAt = [&](double amplitude) {
    Complex sum = 0.0;
    for (int k = 0; k < kPlaces; ++k) {
      const Complex turned = std::polar(1.0, 2.0 * kPi * k / kPlaces);
      const VectorXd x = (amplitude / width.of_shape * turned * mode->shape).real();
      const VectorXd v = motion.v + x.tail(n);
      const VectorXd a = mean.acceleration(motion.q + x.head(n), v, at) - rest;
      sum += std::conj(turned) * (mode->adjoint.head(n).transpose() * x.tail(n).cast<Complex>() +
                                  mode->adjoint.tail(n).transpose() * a.cast<Complex>())
                                     .value();
    }
    const Complex root = 2.0 / kPlaces * width.of_shape / amplitude * sum;
    return -2.0 * kPi * root.real() / root.imag();
  };
  const double small = -2.0 * kPi * mode->root.real() / mode->root.imag();
  const auto holdsAt = [&](double amplitude) {
    return std::fabs(decrementAt(amplitude) - small) <=
           std::max(kSameDecrement * std::fabs(small), kNoDecrement);
  };
  double holds = 0.0;
  for (double amplitude = kSmallest * width.widest; amplitude <= width.widest;
       amplitude *= kAmplitudeStride) {
    if (holdsAt(amplitude)) {
      holds = amplitude;
      continue;
    }
    double beyond = amplitude;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (holds + beyond);
      (holdsAt(middle) ? holds : beyond) = middle;
    }
    found.amplitude = holds;
    break;
  }
  return found;
}

bool hasConditions(const Dynamics& dynamics) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  return !dynamics.singularMass().empty() || !dynamics.conditions(zero, zero, zero, {}).empty();
}

std::vector<Condition> validity(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& v, const EvaluationPoint<double>& at) {
  std::vector<Condition> all = dynamics.conditions(q, v, dynamics.acceleration(q, v, at), at);
  const std::string reason = dynamics.singularMass();
  if (!reason.empty()) {
    all.push_back({"regular_mass", "-", massRegularity(dynamics, q, v, at) - kNearlySingularMass,
                   "the mass matrix is nearly singular: " + reason});
  }
  return all;
}

std::string brokenText(const std::vector<Condition>& conditions, Margins margins) {
  std::string text;
  for (const Condition& c : conditions) {
    if (!(c.margin > 0.0)) {
      const std::string margin =
          margins == Margins::kShown
              ? fmt::format(" {:.3g}{}", c.margin, c.unit == "-" ? "" : " " + c.unit)
              : "";
      text += fmt::format("{}{} ({}{})", text.empty() ? "" : "; ", c.broken, c.name, margin);
    }
  }
  return text;
}

}  // namespace whirl_twin
