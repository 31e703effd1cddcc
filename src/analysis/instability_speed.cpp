#include "analysis/instability_speed.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analysis/characteristic_polynomial.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/equilibria.h"
#include "analysis/routh.h"
#include "analysis/stability.h"

namespace whirl_twin {

namespace {

constexpr double kReach = 1000.0;  // times the lowest natural frequency
constexpr int kStrides = 240;
constexpr int kFewerStrides = 120;  // where each costs milliseconds
constexpr double kGrowth = 1.0e-9;  // or decay, of the largest eigenvalue: no rounding

constexpr double kRounding = 1.0e-15;  // of the largest eigenvalue: no growth

constexpr double kSearchBudget = 1.0e9;  // products, of all exact tests of a search

/// A small motion, the last `zeros` coordinates of which do not matter.
struct SmallMotion {
  Linearization matrices;
  std::size_t zeros = 0;
};

/// At a speed, without the rigid-body modes of a linear rotor, whose zeros rounding would scatter.
SmallMotion motionAt(const Dynamics& dynamics, const Eigen::VectorXd& q, double speed) {
  const Linearization l = linearizationAtRest(dynamics, q, speed);
  if (!dynamics.linear()) {
    return {l, 0};
  }
  const CyclicCoordinates rigid = rigidBodyMotions(l);
  return rigid.any() ? SmallMotion{atFixedMomenta(l, rigid), rigid.driven.size()}
                     : SmallMotion{l, 0};
}

/// The fastest growth of a deviation, in parts of the largest eigenvalue.
double growth(const SmallMotion& motion) {
  const auto roots = eigenvalues(motion.matrices, motion.zeros);
  const auto fastest = std::max_element(
      roots.begin(), roots.end(), [](const auto& a, const auto& b) { return a.real() < b.real(); });
  return roots.back() == 0.0 ? 0.0 : fastest->real() / std::abs(roots.back());
}

bool surelyUnstable(const SmallMotion& motion) {
  return !cannotGrow(motion.matrices) && growth(motion) > kGrowth;
}

/// Tells stable from unstable at the speeds of one search.
class StabilityTest {
 public:
  bool unstable(const SmallMotion& motion) {
    const double fastest = growth(motion);
    if (std::fabs(fastest) > kGrowth) {
      return fastest > 0.0;
    }
    const Linearization& l = motion.matrices;
    if (l.mass.rows() <= kMostExactCoordinates && !budget_spent_) {
      try {
        return routh(characteristicPolynomial(l), budget_).verdict == Verdict::kUnstable;
      } catch (const ExactBudgetSpent&) {
        budget_spent_ = true;
      }
    }
    return !cannotGrow(l) && fastest > kRounding;
  }

 private:
  ExactBudget budget_{kSearchBudget};
  bool budget_spent_ = false;
};

/// Where it rests at a speed, near where it did; a linear rotor is judged anywhere.
std::optional<Eigen::VectorXd> restNear(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                        double speed) {
  return dynamics.linear() ? q : equilibriumNear(dynamics, q, speed);
}

}  // namespace

std::optional<double> instabilitySpeed(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                       double speed) {
  if (!dynamics.hasShaft()) {
    return std::nullopt;
  }
  const double from = dynamics.linear() ? 0.0 : std::fabs(speed);
  const SmallMotion at_first = motionAt(dynamics, q, from);
  if (at_first.matrices.mass.rows() == 0) {
    return std::nullopt;  // nothing is left that could move otherwise
  }
  const auto frequencies = stability(at_first.matrices, at_first.zeros).natural_frequencies;
  if (frequencies.empty()) {
    return std::nullopt;
  }
  const double lowest = std::max(frequencies.front(), 1.0e-6 * std::max(1.0, from));
  const double first = std::max(from, 1.0e-2 * lowest);
  const double last = kReach * lowest;
  std::vector<std::pair<double, Eigen::VectorXd>> passed{{from, q}};
  StabilityTest test;
  const int strides = dynamics.dof() <= kMostExactCoordinates ? kStrides : kFewerStrides;
  for (int i = 0; i <= strides; ++i) {
    const double high = first * std::pow(last / first, static_cast<double>(i) / strides);
    const auto next = restNear(dynamics, passed.back().second, high);
    if (!next) {
      return std::nullopt;
    }
    if (!surelyUnstable(motionAt(dynamics, *next, high))) {
      passed.emplace_back(high, *next);
      continue;
    }
    // What grows too slowly to be sure of has been passed too: Routh's test finds the way back.
    double top = high;
    while (passed.size() > 1 &&
           test.unstable(motionAt(dynamics, passed.back().second, passed.back().first))) {
      top = passed.back().first;
      passed.pop_back();
    }
    double low = passed.back().first;
    const Eigen::VectorXd& before = passed.back().second;
    while (top - low > 1.0e-15 * top) {
      const double middle = 0.5 * (low + top);
      if (middle <= low || middle >= top) {
        break;
      }
      const auto there = restNear(dynamics, before, middle);
      const bool lost = !there || test.unstable(motionAt(dynamics, *there, middle));
      (lost ? top : low) = middle;
    }
    return 0.5 * (low + top);
  }
  return std::nullopt;
}

}  // namespace whirl_twin
