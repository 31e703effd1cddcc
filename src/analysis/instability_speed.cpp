#include "analysis/instability_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "analysis/banded_rotor.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/equilibria.h"
#include "analysis/equilibrium_branch.h"
#include "analysis/linearized_motion.h"
#include "analysis/lowest_eigenvalues.h"
#include "analysis/polynomial_roots.h"
#include "analysis/stability.h"
#include "analysis/unstable_root_bound.h"

namespace whirl_twin {

namespace {

constexpr double kInstabilityReach = 1000.0;  // times the lowest natural frequency
constexpr double kNearStandstill = 1.0e-2;    // of it
constexpr int kSpeedStrides = 240;
constexpr int kFewerStrides = 120;  // where each costs milliseconds
constexpr double kGrows = 1.0e-9;   // of a frequency: no rounding

/// At a speed, without the rigid-body modes of a linear rotor, whose zeros rounding would scatter.
LinearizedMotion ofMeanLoads(const Dynamics& dynamics, const Eigen::VectorXd& q, double speed) {
  const Linearization l = linearizationAtRest(dynamics, q, speed);
  if (!dynamics.linear()) {
    return {l, 0};
  }
  const CyclicCoordinates rigid = rigidBodyMotions(l);
  return rigid.any() ? LinearizedMotion{atFixedMomenta(l, rigid), rigid.driven.size()}
                     : LinearizedMotion{l, 0};
}

LinearizedMotion motionAt(const Dynamics& dynamics, const Eigen::VectorXd& q, double speed) {
  LinearizedMotion small = ofMeanLoads(dynamics, q, speed);
  if (const auto period = timeDependence(dynamics, speed).period) {
    small.periodic =
        periodicMotionNear(dynamics, speed, *period, {q, Eigen::VectorXd::Zero(q.size())});
  }
  return small;
}

/// The equilibrium at a speed near the previous one; for a linear rotor q itself.
std::optional<Eigen::VectorXd> judgedPlaceNear(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                               double speed) {
  return dynamics.linear() ? q : equilibriumNear(dynamics, q, speed);
}

/// [rad/s], of small motions at a speed, the scale of the search; NaN where nothing could become
/// unstable with speed.
double lowestFrequency(const Dynamics& dynamics, const Eigen::VectorXd& q, double speed) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!dynamics.hasShaft()) {
    return kNone;
  }
  const LinearizedMotion motion = motionAt(dynamics, q, speed);
  if (motion.matrices.mass.rows() == 0) {
    return kNone;  // no other coordinate can move
  }
  const auto frequencies = stability(motion.matrices, motion.zeros).natural_frequencies;
  return frequencies.empty() ? kNone : std::max(frequencies.front(), 1.0e-6 * std::max(1.0, speed));
}

int stridesFor(const Dynamics& dynamics) {
  return dynamics.dof() <= kMaxExactCoordinates ? kSpeedStrides : kFewerStrides;
}

/// Growth of the motions of a rotor with many coordinates, relative to their frequency, by the
/// lowest eigenvalues.
class LowestGrowth {
 public:
  explicit LowestGrowth(const LinearRotor& rotor) : rotor_(rotor) {}

  /// At a speed [rad/s], negative where none grows. Nothing where lowestRoots() has no result.
  std::optional<double> at(double speed) {
    const BandedLinearization l = rotor_.matrices(speed);
    const auto radius = unstableRootBound(l);
    if (radius == 0.0) {
      return -1.0;
    }
    const BandedPencil<double> pencil = pencilOf(l);
    // No growing motion lies beyond the radius: where that holds few roots they are all it takes.
    const bool few = radius && *radius <= reach_;
    const auto found = few ? rootsWithin(pencil, *radius) : lowestRoots(pencil, 2 * kLowestModes);
    if (!found) {
      return std::nullopt;
    }
    reach_ = few ? reach_ : found->radius;
    double fastest = -1.0;
    for (const RefinedEigenpair& root : found->roots) {
      fastest = std::max(fastest, root.value.real() / std::abs(root.value));
    }
    return fastest;
  }

 private:
  BandedRotor rotor_;
  double reach_ = 0.0;  // [1/s], of the lowest eigenvalues
};

/// That of a linear rotor of more than kMaxCompleteCoordinates, by its lowest eigenvalues. The
/// outer optional is empty where they cannot be computed.
std::optional<std::optional<double>> ofLongRotor(const LinearRotor& rotor, double lowest) {
  LowestGrowth growth(rotor);
  const double first = kNearStandstill * lowest;
  const double last = kInstabilityReach * lowest;
  double before = 0.0;
  std::optional<double> grew = growth.at(0.0);
  for (int i = 0; i <= kFewerStrides && grew; ++i) {
    const double speed = first * std::pow(last / first, static_cast<double>(i) / kFewerStrides);
    const std::optional<double> grows = growth.at(speed);
    if (!grows) {
      return std::nullopt;
    }
    if (*grows > kGrows) {
      if (*grew >= 0.0) {
        return std::optional<double>(before);
      }
      const auto at = [&](double there) { return growth.at(there).value_or(*grows); };
      return std::optional<double>(bracketedRoot(at, before, speed, *grew, *grows));
    }
    before = speed;
    grew = grows;
  }
  return grew ? std::optional<std::optional<double>>(std::in_place) : std::nullopt;
}

/// Where the verdict changes between two speeds of which one is unstable.
double thresholdBetween(const Dynamics& dynamics, GrowthTest& test, const EquilibriumAt& below,
                        double high, bool unstable_above) {
  double low = below.speed;
  while (high - low > 1.0e-15 * high) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) {
      break;
    }
    const auto there = judgedPlaceNear(dynamics, below.q, middle);
    const bool unstable = !there || test.unstable(motionAt(dynamics, *there, middle));
    (unstable == unstable_above ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// The speed above which an equilibrium is unstable that is so at `present`; 0 where it is so at
/// every speed down to `least` [rad/s].
double instabilitySpeedBelow(const Dynamics& dynamics, GrowthTest& test,
                             const EquilibriumAt& present, double least) {
  const double ratio = std::pow(kInstabilityReach / kNearStandstill, 1.0 / stridesFor(dynamics));
  EquilibriumAt unstable = present;
  while (unstable.speed > least) {
    const double slower = unstable.speed / ratio;
    auto rest = judgedPlaceNear(dynamics, unstable.q, slower);
    if (!rest) {
      break;
    }
    EquilibriumAt next{slower, std::move(*rest)};
    if (!test.unstable(motionAt(dynamics, next.q, slower))) {
      return thresholdBetween(dynamics, test, next, unstable.speed, true);
    }
    unstable = std::move(next);
  }
  return 0.0;
}

}  // namespace

std::optional<double> instabilitySpeed(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                       double speed) {
  const double from = dynamics.linear() ? 0.0 : std::fabs(speed);
  const double lowest = lowestFrequency(dynamics, q, from);
  if (std::isnan(lowest)) {
    return std::nullopt;
  }
  if (dynamics.linear() && dynamics.dof() > kMaxCompleteCoordinates) {
    if (const auto found = ofLongRotor(dynamics.linearRotor(), lowest)) {
      return *found;
    }
  }
  const double first = std::max(from, kNearStandstill * lowest);
  const double last = kInstabilityReach * lowest;
  std::vector<EquilibriumAt> passed{{from, q}};
  GrowthTest test;
  if (!dynamics.linear() && surelyUnstable(motionAt(dynamics, q, from))) {
    return instabilitySpeedBelow(dynamics, test, passed.back(), kNearStandstill * lowest);
  }
  const int strides = stridesFor(dynamics);
  for (int i = 0; i <= strides; ++i) {
    const double high = first * std::pow(last / first, static_cast<double>(i) / strides);
    const auto next = judgedPlaceNear(dynamics, passed.back().q, high);
    if (!next) {
      return std::nullopt;
    }
    if (!surelyUnstable(motionAt(dynamics, *next, high))) {
      passed.push_back({high, *next});
      continue;
    }
    // What grows too slowly to be sure of has been passed too: Routh's test finds the way back.
    double top = high;
    while (passed.size() > 1 &&
           test.unstable(motionAt(dynamics, passed.back().q, passed.back().speed))) {
      top = passed.back().speed;
      passed.pop_back();
    }
    return thresholdBetween(dynamics, test, passed.back(), top, true);
  }
  return std::nullopt;
}

std::vector<StabilityThreshold> stabilityThresholds(const Dynamics& dynamics,
                                                    const Eigen::VectorXd& q, double speed) {
  const double lowest = lowestFrequency(dynamics, q, dynamics.linear() ? 0.0 : std::fabs(speed));
  if (std::isnan(lowest)) {
    return {};
  }
  const double first = kNearStandstill * lowest;
  const double last = kInstabilityReach * lowest;
  const double ratio = std::pow(last / first, 1.0 / stridesFor(dynamics));
  const double from = dynamics.linear() ? first : std::max(std::fabs(speed), first);
  std::vector<EquilibriumAt> points = equilibriumBranch(dynamics, q, from, first, ratio);
  if (dynamics.linear()) {
    points.push_back({0.0, q});
  }
  std::reverse(points.begin(), points.end());
  const std::vector<EquilibriumAt> upward =
      equilibriumBranch(dynamics, q, from, std::max(last, from), ratio);
  points.insert(points.end(), upward.begin() + 1, upward.end());

  std::vector<StabilityThreshold> found;
  GrowthTest test;
  bool before = false;  // unstable
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LinearizedMotion motion = motionAt(dynamics, points[i].q, points[i].speed);
    // Inconclusive growth or decay requires an exact test, and only next to a growing motion.
    const bool sure = surelyUnstable(motion);
    const bool now = sure || (before && test.unstable(motion));
    if (i == 0) {
      before = now;
      if (now) {
        found.push_back({0.0, true});
      }
      continue;
    }
    if (now != before) {
      std::size_t stable = i - 1;  // what grew too slowly to be sure of has been passed too
      std::size_t grown = i;
      while (now && stable > 0 &&
             test.unstable(motionAt(dynamics, points[stable].q, points[stable].speed))) {
        grown = stable--;
      }
      if (found.empty() || points[stable].speed >= found.back().speed) {
        found.push_back(
            {thresholdBetween(dynamics, test, points[stable], points[grown].speed, now), now});
      } else {  // it had not become stable in between
        found.pop_back();
      }
      before = now;
    }
  }
  return found;
}

}  // namespace whirl_twin
