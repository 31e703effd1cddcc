#include "analysis/decrement_amplitude.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "algebra/eigenvalues.h"
#include "algebra/lu.h"
#include "algebra/svd.h"
#include "analysis/equilibria.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;
constexpr int kPlaces = 32;            // of a cycle
constexpr double kSmallest = 1.0e-7;   // of the widest
constexpr double kStride = 1.25;       // from one amplitude to the next
constexpr int kHalvings = 20;          // of the last stride
constexpr double kVibrates = 1.0e-9;   // of the fastest motion: what turns more slowly is at rest
constexpr double kParted = 1.0e-10;    // modes are two, of shapes that are known
constexpr double kNoDecrement = 1e-6;  // differences below it are none

/// A mode about a steady motion.
struct Mode {
  Complex root;  ///< [1/s]
  VectorXcd shape, adjoint;
};

std::optional<Mode> leastDamped(const Dynamics& mean, const SteadyMotion& motion, double speed) {
  const Linearization l = linearizationAbout(mean, motion.q, motion.v, speed);
  const Index n = l.mass.rows();
  const Eigen::PartialPivLU<MatrixXd> mass(l.mass);
  MatrixXd state = MatrixXd::Zero(2 * n, 2 * n);
  state.topRightCorner(n, n).setIdentity();
  state.bottomLeftCorner(n, n) = -mass.solve(l.stiffness + l.circulatory);
  state.bottomRightCorner(n, n) = -mass.solve(l.damping + l.gyroscopic);
  if (!state.allFinite()) {
    return std::nullopt;
  }
  const Eigen::EigenSolver<MatrixXd> solver(state);
  const VectorXcd& roots = solver.eigenvalues();
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
  const VectorXcd shape = solver.eigenvectors().col(least);
  const Eigen::JacobiSVD<MatrixXcd> shapes(solver.eigenvectors());
  const auto& values = shapes.singularValues();
  if (!(values.minCoeff() > kParted * values.maxCoeff())) {
    return std::nullopt;
  }
  const VectorXcd unit = VectorXcd::Unit(2 * n, least);
  const VectorXcd adjoint =
      Eigen::FullPivLU<MatrixXcd>(solver.eigenvectors().transpose()).solve(unit);
  return Mode{roots[least], shape, adjoint};
}

/// How wide the shape is, and in what.
DecrementAmplitude widthOf(const Dynamics& dynamics, const VectorXcd& shape) {
  const Index n = dynamics.dof();
  DecrementAmplitude width;
  if (dynamics.isRotor()) {
    const Station station = dynamics.stations().front();
    const Complex x = station.along_x.dot(shape.head(n).real()) +
                      Complex(0.0, 1.0) * station.along_x.dot(shape.head(n).imag());
    const Complex y = station.along_y.dot(shape.head(n).real()) +
                      Complex(0.0, 1.0) * station.along_y.dot(shape.head(n).imag());
    const Complex forward = x + Complex(0.0, 1.0) * y;
    const Complex backward = std::conj(x) + Complex(0.0, 1.0) * std::conj(y);
    width.coordinate = "whirl";
    width.amplitude = 0.5 * (std::abs(forward) + std::abs(backward));
    return width;
  }
  const std::vector<CoordinateInfo> all = dynamics.coordinates();
  double most = -1.0;
  for (Index i = 0; i < n; ++i) {
    const auto& coordinate = all[static_cast<std::size_t>(i)];
    const double part =
        std::abs(shape[i]) / (coordinate.isAngle() ? 1.0 : dynamics.naturalLength());
    if (part > most) {
      most = part;
      width = {std::abs(shape[i]), coordinate.name};
    }
  }
  return width;
}

}  // namespace

std::optional<DecrementAmplitude> decrementAmplitude(const Dynamics& dynamics,
                                                     const SteadyMotion& motion, double speed) {
  const Dynamics& mean = dynamics.atMeanLoad();
  const std::optional<Mode> mode = leastDamped(mean, motion, speed);
  if (!mode) {
    return std::nullopt;
  }
  DecrementAmplitude found = widthOf(dynamics, mode->shape);
  const double width = std::exchange(found.amplitude, std::numeric_limits<double>::infinity());
  if (dynamics.linear() || !(width > 0.0)) {
    return found;
  }
  const Index n = mean.dof();
  const Moment<double> at{0.0, 0.0, speed, 0.0};
  const VectorXd rest = mean.acceleration(motion.q, motion.v, at);
  const auto decrementAt = [&](double amplitude) {
    Complex sum = 0.0;
    for (int k = 0; k < kPlaces; ++k) {
      const Complex turned = std::polar(1.0, 2.0 * kPi * k / kPlaces);
      const VectorXd x = (amplitude / width * turned * mode->shape).real();
      const VectorXd v = motion.v + x.tail(n);
      const VectorXd a = mean.acceleration(motion.q + x.head(n), v, at) - rest;
      sum += std::conj(turned) * (mode->adjoint.head(n).transpose() * x.tail(n).cast<Complex>() +
                                  mode->adjoint.tail(n).transpose() * a.cast<Complex>())
                                     .value();
    }
    const Complex root = 2.0 / kPlaces * width / amplitude * sum;
    return -2.0 * kPi * root.real() / root.imag();
  };
  const double small = -2.0 * kPi * mode->root.real() / mode->root.imag();
  const auto holdsAt = [&](double amplitude) {
    return std::fabs(decrementAt(amplitude) - small) <=
           std::max(kSameDecrement * std::fabs(small), kNoDecrement);
  };
  const bool angle = !dynamics.isRotor() && [&] {
    const std::vector<CoordinateInfo> all = dynamics.coordinates();
    return std::any_of(all.begin(), all.end(), [&](const CoordinateInfo& c) {
      return c.name == found.coordinate && c.isAngle();
    });
  }();
  const double widest = angle ? kPi : dynamics.naturalLength();
  double holds = 0.0;
  for (double amplitude = kSmallest * widest; amplitude <= widest; amplitude *= kStride) {
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

}  // namespace whirl_twin
