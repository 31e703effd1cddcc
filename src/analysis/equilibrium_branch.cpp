#include "analysis/equilibrium_branch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "analysis/equilibria.h"

namespace whirl_twin {
namespace {

constexpr double kRatio = 1.05;
constexpr double kSlower = 100.0;  // times below the lowest natural frequency
constexpr double kFaster = 50.0;   // times above the highest
// [rad/s], search speeds for a first equilibrium: a film carries no load at standstill.
constexpr double kFirstSpeeds[] = {100.0, 30.0, 300.0, 10.0, 1000.0, 3.0, 3000.0, 1.0};

/// The equilibrium nearest to the line of the bearings at the first speed that has one.
std::optional<EquilibriumAt> anyRest(const Dynamics& dynamics) {
  for (const double speed : kFirstSpeeds) {
    std::optional<EquilibriumAt> nearest;
    for (const Equilibrium& e : equilibria(dynamics, speed)) {
      if (!nearest || e.q.norm() < nearest->q.norm()) {
        nearest = EquilibriumAt{speed, e.q};
      }
    }
    if (nearest) {
      return nearest;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<EquilibriumAt> equilibriumBranch(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                             double speed, double end, double ratio) {
  std::vector<EquilibriumAt> points{{speed, q}};
  const bool upward = end > speed;
  while (upward ? points.back().speed < end : points.back().speed > end) {
    const double next = upward ? std::min(points.back().speed * ratio, end)
                               : std::max(points.back().speed / ratio, end);
    auto rest = dynamics.linear() ? std::optional<Eigen::VectorXd>(q)
                                  : equilibriumNear(dynamics, points.back().q, next);
    if (!rest) {
      break;
    }
    points.push_back({next, std::move(*rest)});
  }
  return points;
}

LinearizedMotionRotor linearizedMotionRotor(const Dynamics& dynamics) {
  LinearizedMotionRotor small;
  const std::optional<EquilibriumAt> start = anyRest(dynamics);
  if (!start) {
    return small;
  }
  const auto frequencies =
      stability(linearizationAtRest(dynamics, start->q, start->speed)).natural_frequencies;
  if (frequencies.empty()) {
    return small;
  }
  auto points = std::make_shared<std::vector<EquilibriumAt>>(
      equilibriumBranch(dynamics, start->q, start->speed,
                        std::min(frequencies.front() / kSlower, start->speed), kRatio));
  std::reverse(points->begin(), points->end());
  const auto upward =
      equilibriumBranch(dynamics, start->q, start->speed,
                        std::max(frequencies.back() * kFaster, start->speed), kRatio);
  points->insert(points->end(), upward.begin() + 1, upward.end());
  small.lowest = points->front().speed;
  small.highest = points->back().speed;
  small.rotor.speed_dependent = true;
  small.rotor.load = Eigen::VectorXd::Zero(dynamics.dof());
  small.rotor.matrices = [&dynamics, points](double speed) {
    const auto above =
        std::lower_bound(points->begin(), points->end(), speed,
                         [](const EquilibriumAt& p, double s) { return p.speed < s; });
    const EquilibriumAt& near = above == points->end() ? points->back() : *above;
    const auto rest = equilibriumNear(dynamics, near.q, speed);
    return linearizationAtRest(dynamics, rest.value_or(near.q), speed);
  };
  return small;
}

}  // namespace whirl_twin
