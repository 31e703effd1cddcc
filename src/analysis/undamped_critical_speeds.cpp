#include "analysis/undamped_critical_speeds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "algebra/dense.h"
#include "analysis/polynomial_roots.h"
#include "analysis/whirl_modes.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kPlane = 2;  // coordinates of a node: x, beta

/// The rotor without its supports, in the plane of x and beta.
struct ForwardWhirl {
  MatrixXd stiffness;  ///< K
  MatrixXd inertia;    ///< M - G1
};

ForwardWhirl forwardWhirl(FlexibleShaft shaft) {
  shaft.bearings.clear();
  shaft.speed_bearings.clear();
  shaft.pedestals.clear();
  shaft.internal_damping = shaft.mass_damping = shaft.stiffness_damping = 0.0;
  const Index nodes = shaft.nodes();
  const Linearization l = RotorAssembly::unsupported(shaft).matrices(1.0);
  // x and beta of the plane, and where y and alpha follow: y = -i x, alpha = i beta.
  const auto own = [](Index k) { return kNodeCoordinates * (k / kPlane) + (k % kPlane) * 3; };
  const auto other = [](Index k) { return kNodeCoordinates * (k / kPlane) + 1 + k % kPlane; };
  ForwardWhirl whirl;
  whirl.stiffness.resize(kPlane * nodes, kPlane * nodes);
  whirl.inertia.resize(kPlane * nodes, kPlane * nodes);
  for (Index i = 0; i < kPlane * nodes; ++i) {
    for (Index j = 0; j < kPlane * nodes; ++j) {
      whirl.stiffness(i, j) = l.stiffness(own(i), own(j));
      // The entry of -i G between own(i) and other(j), whose coordinate is -+i times the own one.
      const double sign = j % kPlane == 0 ? -1.0 : 1.0;
      whirl.inertia(i, j) = l.mass(own(i), own(j)) + sign * l.gyroscopic(own(i), other(j));
    }
  }
  for (const RigidSupport& support : shaft.rigid_supports) {
    if (support.clamps) {  // no slope
      const Index beta = kPlane * support.node + 1;
      for (MatrixXd* matrix : {&whirl.stiffness, &whirl.inertia}) {
        matrix->row(beta).setZero();
        matrix->col(beta).setZero();
      }
      whirl.stiffness(beta, beta) = 1.0;
    }
  }
  return whirl;
}

/// [rad/s], ascending, as many as `modes`.
std::vector<double> speedsOf(const MatrixXd& stiffness, const MatrixXd& inertia,
                             std::size_t modes) {
  const Cholesky factor(stiffness);
  if (!factor.succeeded()) {
    throw RunFailure("undamped critical speeds: the shaft buckles under its axial force");
  }
  const MatrixXd half = factor.solveLower(inertia);
  const VectorXd mu = symmetricEigenvalues(factor.solveLower(half.transpose())).reverse();
  std::vector<double> speeds;
  for (const double one : mu) {
    if (one > 0.0 && speeds.size() < modes) {
      speeds.push_back(1.0 / std::sqrt(one));
    }
  }
  return speeds;
}

/// On supports that do not yield: without their x.
std::vector<double> rigidSpeeds(const ForwardWhirl& whirl, const std::set<int>& supports,
                                std::size_t modes) {
  std::vector<Index> free;
  for (Index k = 0; k < whirl.stiffness.rows(); ++k) {
    if (k % kPlane != 0 || supports.count(static_cast<int>(k / kPlane)) == 0) {
      free.push_back(k);
    }
  }
  const auto size = static_cast<Index>(free.size());
  MatrixXd stiffness(size, size), inertia(size, size);
  for (Index i = 0; i < size; ++i) {
    for (Index j = 0; j < size; ++j) {
      const Index from = free[static_cast<std::size_t>(i)];
      const Index to = free[static_cast<std::size_t>(j)];
      stiffness(i, j) = whirl.stiffness(from, to);
      inertia(i, j) = whirl.inertia(from, to);
    }
  }
  return speedsOf(stiffness, inertia, modes);
}

}  // namespace

CriticalSpeedMap criticalSpeedMap(const FlexibleShaft& shaft, const std::vector<int>& supports,
                                  double from, double to, int points, std::size_t modes) {
  const std::set<int> places(supports.begin(), supports.end());
  if (places.size() < 2) {
    throw InputError("undamped critical speeds: expected bearings at two nodes or more");
  }
  const ForwardWhirl whirl = forwardWhirl(shaft);
  CriticalSpeedMap map;
  map.rigid = rigidSpeeds(whirl, places, modes);
  for (int i = 0; i < points; ++i) {
    const double k = from * std::pow(to / from, static_cast<double>(i) / (points - 1));
    MatrixXd stiffness = whirl.stiffness;
    for (const int node : places) {
      stiffness(kPlane * node, kPlane * node) += k;
    }
    map.stiffness.push_back(k);
    const std::vector<double> speeds = speedsOf(stiffness, whirl.inertia, modes);
    map.speeds.resize(std::max(map.speeds.size(), speeds.size()));
    for (std::size_t mode = 0; mode < map.speeds.size(); ++mode) {
      map.speeds[mode].resize(map.stiffness.size() - 1, std::numeric_limits<double>::quiet_NaN());
      map.speeds[mode].push_back(mode < speeds.size() ? speeds[mode]
                                                      : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return map;
}

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRepeatedSpeed = 1.0e-9;  // of a critical speed
constexpr double kStiffened =
    1.0e-11;  // of the largest stiffness: on springs as soft a free rotor drifts
constexpr int kFlexibilityStrides = 200;

/// (M - i G/w) phi = mu K phi at one speed: mu descending.
struct Pencil {
  VectorXd mu;          // [s^2]
  MatrixXcd shapes;     // columns
  double spring = 0.0;  // [N/m], added to every coordinate of a free rotor
};

Pencil pencil(const LinearRotor& rotor, double speed, bool vectors) {
  const Linearization l = rotor.matrices(speed);
  MatrixXd stiffness = 0.5 * (l.stiffness + l.stiffness.transpose());
  Cholesky factor(stiffness);
  double spring = 0.0;
  if (!factor.succeeded()) {
    spring = kStiffened * stiffness.cwiseAbs().maxCoeff();
    stiffness.diagonal().array() += spring;
    factor = Cholesky(stiffness);
  }
  if (!factor.succeeded()) {
    throw RunFailure(
        "undamped critical speeds: the stiffness of the rotor is negative for some motion");
  }
  const MatrixXcd inertia =
      l.mass.cast<Complex>() - Complex(0.0, 1.0 / speed) * l.gyroscopic.cast<Complex>();
  const MatrixXcd root = factor.lower().cast<Complex>();
  const auto lower = root.triangularView<Eigen::Lower>();
  const MatrixXcd half = lower.solve(inertia);
  MatrixXcd a = lower.solve(half.adjoint());
  const auto solver = hermitianModes(a, vectors);
  Pencil found{solver.values.reverse(), {}, spring};
  if (vectors) {
    found.shapes = lower.adjoint().solve(solver.vectors.rowwise().reverse());
  }
  return found;
}

/// Does a shape rest on the added springs alone?
bool restsOnAddedSprings(const LinearRotor& rotor, double speed, const Pencil& there,
                         const Eigen::VectorXcd& shape) {
  const MatrixXd stiffness = rotor.matrices(speed).stiffness;
  const double energy = shape.dot(stiffness.cast<Complex>() * shape).real();
  return there.spring > 0.0 && energy < 10.0 * there.spring * shape.squaredNorm();
}

/// Roots of w^2 mu_i(w) = 1 for each place i, in (0, highest].
std::vector<double> roots(const LinearRotor& rotor, double highest) {
  std::vector<double> speeds;
  const double any = 0.5 * highest;
  if (!rotor.speed_dependent || rotor.knots.empty()) {
    // Gyroscopic terms alone change with the speed, and in proportion: mu does not.
    const VectorXd mu = pencil(rotor, any, false).mu;
    const VectorXd elsewhere = pencil(rotor, 0.125 * highest, false).mu;
    if ((mu - elsewhere).cwiseAbs().maxCoeff() <= 1.0e-11 * mu.cwiseAbs().maxCoeff()) {
      for (const double one : mu) {
        if (one > 0.0 && 1.0 <= one * highest * highest) {
          speeds.push_back(1.0 / std::sqrt(one));
        }
      }
      return speeds;
    }
  }
  std::vector<double> grid = rotor.knots;
  for (int k = 0; k <= kFlexibilityStrides; ++k) {
    const double part = static_cast<double>(k) / kFlexibilityStrides;
    grid.push_back(highest * std::pow(1.0e-3, 1.0 - part));
  }
  std::sort(grid.begin(), grid.end());
  grid.erase(
      std::remove_if(grid.begin(), grid.end(), [&](double w) { return w <= 0.0 || w > highest; }),
      grid.end());
  VectorXd before;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const VectorXd now = grid[k] * grid[k] * pencil(rotor, grid[k], false).mu.array() - 1.0;
    for (Index i = 0; k > 0 && i < now.size(); ++i) {
      if ((before[i] < 0.0) != (now[i] < 0.0)) {
        const auto excess = [&](double w) { return w * w * pencil(rotor, w, false).mu[i] - 1.0; };
        speeds.push_back(bracketedRoot(excess, grid[k - 1], grid[k], before[i], now[i]));
      }
    }
    before = now;
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

}  // namespace

std::vector<UndampedCriticalSpeed> undampedCriticalSpeeds(const LinearRotor& rotor,
                                                          const std::vector<Station>& stations,
                                                          double highest) {
  const std::vector<double> speeds = roots(rotor, highest);
  std::vector<UndampedCriticalSpeed> found;
  for (std::size_t first = 0; first < speeds.size();) {
    std::size_t end = first + 1;
    while (end < speeds.size() && speeds[end] - speeds[end - 1] <= kRepeatedSpeed * speeds[end]) {
      ++end;
    }
    const double speed = speeds[first];
    const Pencil there = pencil(rotor, speed, true);
    // The shapes whose w^2 mu is nearest to 1, those of one critical speed distinguished by
    // direction.
    const VectorXd distance = (speed * speed * there.mu.array() - 1.0).abs();
    std::vector<Index> order(static_cast<std::size_t>(distance.size()));
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = static_cast<Index>(i);
    }
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return distance[a] < distance[b]; });
    MatrixXcd shapes(there.shapes.rows(), static_cast<Index>(end - first));
    for (Index k = 0; k < shapes.cols(); ++k) {
      shapes.col(k) = there.shapes.col(order[static_cast<std::size_t>(k)]);
    }
    if (shapes.cols() > 1) {
      shapes = separatedByDirection(shapes, stations).rowwise().reverse().eval();
    }
    for (Index k = 0; k < shapes.cols(); ++k) {
      WhirlMode mode;
      mode.shape = shapes.col(k);
      if (restsOnAddedSprings(rotor, speed, there, mode.shape)) {
        continue;
      }
      normalise(mode, stations);
      found.push_back({speeds[first + static_cast<std::size_t>(k)], mode.whirl, mode.orbits});
    }
    first = end;
  }
  return found;
}

}  // namespace whirl_twin
