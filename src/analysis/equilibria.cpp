#include "analysis/equilibria.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kStartsPerCoordinate = 8;
constexpr int kMaxIterations = 100;
constexpr double kSame = 1.0e-6;  // closer than this is the same equilibrium, rad or m

bool isAngle(const Coordinate& coordinate) {
  return std::string(coordinate.unit) == "rad";
}

/// Deviation of q from p, angles by the shorter way round.
double distance(const std::vector<Coordinate>& coordinates, const Eigen::VectorXd& q,
                const Eigen::VectorXd& p) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double d = q[i] - p[i];
    const double short_way =
        isAngle(coordinates[static_cast<std::size_t>(i)]) ? std::remainder(d, 2.0 * kPi) : d;
    sum += short_way * short_way;
  }
  return std::sqrt(sum);
}

/// Angles into (-pi, pi], noise about zero away.
Eigen::VectorXd tidied(const std::vector<Coordinate>& coordinates, Eigen::VectorXd q) {
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    if (isAngle(coordinates[static_cast<std::size_t>(i)])) {
      q[i] = std::remainder(q[i], 2.0 * kPi);
      if (q[i] < -kPi + 1.0e-12) {
        q[i] = kPi;
      }
    }
    if (std::fabs(q[i]) < 1.0e-12) {
      q[i] = 0.0;
    }
  }
  return q;
}

Eigen::VectorXd start(int index, Eigen::Index dof) {
  Eigen::VectorXd q(dof);
  for (Eigen::Index i = 0; i < dof; ++i) {
    // Off the symmetric points, where Newton's method could rest by accident.
    q[i] = 0.1 + 2.0 * kPi * (index % kStartsPerCoordinate) / kStartsPerCoordinate - kPi;
    index /= kStartsPerCoordinate;
  }
  return q;
}

}  // namespace

Linearization linearizationAtRest(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                  double speed) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  return dynamics.linearization(q, zero, zero, {0.0, 0.0, speed, 0.0});
}

std::optional<Eigen::VectorXd> equilibriumNear(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                               double speed) {
  if (dynamics.linear()) {
    return Eigen::VectorXd(Eigen::VectorXd::Zero(dynamics.dof()));
  }
  const Moment<double> at{0.0, 0.0, speed, 0.0};
  Eigen::VectorXd x = q;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Linearization l = linearizationAtRest(dynamics, x, speed);
    const Eigen::VectorXd correction =
        Eigen::FullPivLU<Eigen::MatrixXd>(l.stiffness + l.circulatory)
            .solve(dynamics.holdingForce(x, at));
    const double size = correction.norm();
    if (!std::isfinite(size)) {
      return std::nullopt;
    }
    x += correction * std::min(1.0, 1.0 / std::max(size, 1.0e-300));
    if (size < 1.0e-14 * (1.0 + x.norm())) {
      return x;
    }
  }
  // Where an equilibrium branches Newton's method is slow: near is good enough if nothing pulls.
  const double pull = dynamics.holdingForce(x, at).norm();
  const double scale =
      linearizationAtRest(dynamics, x, speed).mass.norm() *
      std::max(speed * speed, dynamics.acceleration(q, Eigen::VectorXd::Zero(q.size()), at).norm());
  return pull <= 1.0e-12 * scale ? std::optional<Eigen::VectorXd>(x) : std::nullopt;
}

std::vector<Equilibrium> equilibria(const Dynamics& dynamics, double speed) {
  const std::vector<Coordinate> coordinates = dynamics.coordinates();
  int starts = 1;
  for (int i = 0; i < dynamics.dof() && !dynamics.linear(); ++i) {
    starts *= kStartsPerCoordinate;
  }
  std::vector<Eigen::VectorXd> found;
  for (int s = 0; s < starts; ++s) {
    const auto q = equilibriumNear(dynamics, start(s, dynamics.dof()), speed);
    if (!q) {
      continue;
    }
    const Eigen::VectorXd candidate = tidied(coordinates, *q);
    if (std::none_of(found.begin(), found.end(), [&](const Eigen::VectorXd& other) {
          return distance(coordinates, candidate, other) < kSame;
        })) {
      found.push_back(candidate);
    }
  }
  std::sort(found.begin(), found.end(), [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return std::lexicographical_compare(a.data(), a.data() + a.size(), b.data(),
                                        b.data() + b.size());
  });
  std::vector<Equilibrium> all;
  for (const Eigen::VectorXd& q : found) {
    all.push_back({q, stability(linearizationAtRest(dynamics, q, speed))});
  }
  return all;
}

std::optional<Equilibrium> operatingPoint(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                          double speed) {
  const std::vector<Coordinate> coordinates = dynamics.coordinates();
  std::optional<Equilibrium> nearest;
  double nearest_distance = 0.0;
  for (const Equilibrium& e : equilibria(dynamics, speed)) {
    const double d = distance(coordinates, e.q, q);
    if (e.stability.bounded() && (!nearest || d < nearest_distance)) {
      nearest = e;
      nearest_distance = d;
    }
  }
  return nearest;
}

}  // namespace whirl_twin
