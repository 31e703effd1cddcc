#include "analysis/critical_speed_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "algebra/dense.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kPlane = 2;  // coordinates of a node: x, beta

/// The rotor without what it stands on, in the plane of x and beta.
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
    throw RunFailure("critical speed map: the shaft buckles under its axial force");
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
    throw Refusal("critical speed map: expected bearings at two nodes or more");
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

}  // namespace whirl_twin
