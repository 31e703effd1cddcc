#include "analysis/equilibria.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kStartsPerTurn = 8;
constexpr int kTurnsOfOneSlide = 8;  // searched where a sliding coordinate is the only one
constexpr int kMaxIterations = 100;
constexpr double kSame = 1.0e-6;  // closer than this is the same equilibrium, rad or lengths

bool isAngle(const Coordinate& coordinate) {
  return std::string(coordinate.unit) == "rad";
}

/// A radian of each coordinate: of a sliding one, the model's natural length [m].
Eigen::VectorXd units(const Dynamics& dynamics) {
  Eigen::VectorXd unit(dynamics.dof());
  const std::vector<Coordinate> coordinates = dynamics.coordinates();
  for (Eigen::Index i = 0; i < unit.size(); ++i) {
    unit[i] = isAngle(coordinates[static_cast<std::size_t>(i)]) ? 1.0 : dynamics.naturalLength();
  }
  return unit;
}

/// Deviation of q from p in units, angles by the shorter way round.
double distance(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& p) {
  const std::vector<Coordinate> coordinates = dynamics.coordinates();
  Eigen::VectorXd d = (q - p).cwiseQuotient(units(dynamics));
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    if (isAngle(coordinates[static_cast<std::size_t>(i)])) {
      d[i] = std::remainder(d[i], 2.0 * kPi);
    }
  }
  return d.norm();
}

/// Angles into (-pi, pi], noise about zero away.
Eigen::VectorXd tidied(const Dynamics& dynamics, Eigen::VectorXd q) {
  const std::vector<Coordinate> coordinates = dynamics.coordinates();
  const Eigen::VectorXd unit = units(dynamics);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    if (isAngle(coordinates[static_cast<std::size_t>(i)])) {
      q[i] = std::remainder(q[i], 2.0 * kPi);
      if (q[i] < -kPi + 1.0e-12) {
        q[i] = kPi;
      }
    }
    if (std::fabs(q[i]) < 1.0e-12 * unit[i]) {
      q[i] = 0.0;
    }
  }
  return q;
}

/// Starts of Newton's method over one coordinate: round the circle, or as far to both sides. Along
/// a cyclic one every place is the same.
std::vector<double> starts(const Dynamics& dynamics, Eigen::Index coordinate, bool cyclic) {
  if (cyclic) {
    return {0.0};
  }
  const double unit = units(dynamics)[coordinate];
  const bool angle = isAngle(dynamics.coordinates()[static_cast<std::size_t>(coordinate)]);
  const int turns = !angle && dynamics.dof() == 1 ? kTurnsOfOneSlide : 1;
  std::vector<double> all;
  for (int i = 0; i < turns * kStartsPerTurn; ++i) {
    // Off the symmetric points, where Newton's method could rest by accident.
    all.push_back(unit * (0.1 + 2.0 * kPi * i / kStartsPerTurn - turns * kPi));
  }
  return all;
}

/// Which coordinates appear in no force? Judged at a place in general position: derivatives are
/// exact, and zero there is zero everywhere.
std::vector<bool> cyclicCoordinates(const Dynamics& dynamics, double speed) {
  const Eigen::VectorXd anywhere =
      units(dynamics).cwiseProduct(Eigen::VectorXd::LinSpaced(dynamics.dof(), 0.7, 1.3));
  const Linearization l = linearizationAtRest(dynamics, anywhere, speed);
  const Eigen::MatrixXd k = l.stiffness + l.circulatory;
  std::vector<bool> cyclic;
  for (Eigen::Index i = 0; i < k.cols(); ++i) {
    cyclic.push_back((k.col(i).array() == 0.0).all());
  }
  return cyclic;
}

/// All combinations of the starts of each coordinate.
std::vector<Eigen::VectorXd> grid(const Dynamics& dynamics, double speed) {
  std::vector<Eigen::VectorXd> points{Eigen::VectorXd::Zero(dynamics.dof())};
  if (dynamics.linear()) {
    return points;
  }
  const std::vector<bool> cyclic = cyclicCoordinates(dynamics, speed);
  for (Eigen::Index i = 0; i < dynamics.dof(); ++i) {
    std::vector<Eigen::VectorXd> finer;
    for (const double start : starts(dynamics, i, cyclic[static_cast<std::size_t>(i)])) {
      for (Eigen::VectorXd point : points) {
        point[i] = start;
        finer.push_back(point);
      }
    }
    points = finer;
  }
  return points;
}

}  // namespace

Linearization linearizationAtRest(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                  double speed) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  return dynamics.atMeanLoad().linearization(q, zero, zero, {0.0, 0.0, speed, 0.0});
}

std::optional<Eigen::VectorXd> equilibriumNear(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                               double speed) {
  if (dynamics.linear()) {
    return Eigen::VectorXd(Eigen::VectorXd::Zero(dynamics.dof()));
  }
  const Moment<double> at{0.0, 0.0, speed, 0.0};
  const auto holdingForce = [&](const Eigen::VectorXd& x) {
    return dynamics.atMeanLoad().holdingForce(x, at);
  };
  const Eigen::VectorXd unit = units(dynamics);
  Eigen::VectorXd x = q;
  for (int i = 0; i < kMaxIterations; ++i) {
    // In units, so that one measure serves angles and lengths.
    const Linearization l = linearizationAtRest(dynamics, x, speed);
    const Eigen::MatrixXd stiffness =
        unit.asDiagonal() * (l.stiffness + l.circulatory) * unit.asDiagonal();
    const Eigen::VectorXd force = unit.cwiseProduct(holdingForce(x));
    const Eigen::VectorXd correction = Eigen::FullPivLU<Eigen::MatrixXd>(stiffness).solve(force);
    const double size = correction.norm();
    if (!std::isfinite(size)) {
      return std::nullopt;
    }
    x += unit.cwiseProduct(correction) * std::min(1.0, 1.0 / std::max(size, 1.0e-300));
    if (size < 1.0e-14 * (1.0 + x.cwiseQuotient(unit).norm())) {
      // A force that no stiffness answers is left where a coordinate is free to run away.
      const bool held = (force - stiffness * correction).norm() <= 1.0e-9 * stiffness.norm();
      return held ? std::optional<Eigen::VectorXd>(x) : std::nullopt;
    }
  }
  // Where an equilibrium branches Newton's method is slow: near is good enough if nothing pulls.
  const double pull = holdingForce(x).norm();
  const double scale =
      linearizationAtRest(dynamics, x, speed).mass.norm() *
      std::max(speed * speed, dynamics.acceleration(q, Eigen::VectorXd::Zero(q.size()), at).norm());
  return pull <= 1.0e-12 * scale ? std::optional<Eigen::VectorXd>(x) : std::nullopt;
}

std::vector<Equilibrium> equilibria(const Dynamics& dynamics, double speed) {
  std::vector<Eigen::VectorXd> found;
  for (const Eigen::VectorXd& start : grid(dynamics, speed)) {
    const auto q = equilibriumNear(dynamics, start, speed);
    if (!q) {
      continue;
    }
    const Eigen::VectorXd candidate = tidied(dynamics, *q);
    if (std::none_of(found.begin(), found.end(), [&](const Eigen::VectorXd& other) {
          return distance(dynamics, candidate, other) < kSame;
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
    const Linearization l = linearizationAtRest(dynamics, q, speed);
    if (l.mass.diagonal().minCoeff() > 0.0) {
      all.push_back({q, stability(l)});
    }
  }
  return all;
}

std::optional<Equilibrium> operatingPoint(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                          double speed) {
  std::optional<Equilibrium> nearest;
  double nearest_distance = 0.0;
  for (const Equilibrium& e : equilibria(dynamics, speed)) {
    const double d = distance(dynamics, e.q, q);
    if (e.stability.bounded() && (!nearest || d < nearest_distance)) {
      nearest = e;
      nearest_distance = d;
    }
  }
  return nearest;
}

}  // namespace whirl_twin
