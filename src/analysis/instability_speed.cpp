#include "analysis/instability_speed.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analysis/characteristic_polynomial.h"
#include "analysis/equilibria.h"
#include "analysis/routh.h"
#include "analysis/stability.h"

namespace whirl_twin {

namespace {

constexpr double kReach = 1000.0;  // times the lowest natural frequency
constexpr int kStrides = 240;
constexpr int kFewerStrides = 120;  // where each costs milliseconds
constexpr double kGrowth = 1.0e-9;  // of the largest eigenvalue: surely unstable

constexpr double kRounding = 1.0e-15;  // of the largest eigenvalue: no growth

/// Some deviation grows faster than by this part of the largest eigenvalue.
bool grows(const Linearization& l, double part) {
  const auto roots = eigenvalues(l);
  const double largest = std::abs(roots.back());
  return std::any_of(roots.begin(), roots.end(),
                     [&](const auto& root) { return root.real() > part * largest; });
}

bool surelyUnstable(const Linearization& l) {
  return grows(l, kGrowth);
}

bool unstable(const Linearization& l) {
  return l.mass.rows() <= kMostExactCoordinates
             ? routh(characteristicPolynomial(l)).verdict == Verdict::kUnstable
             : grows(l, kRounding);
}

}  // namespace

std::optional<double> instabilitySpeed(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                       double speed) {
  if (!dynamics.hasShaft()) {
    return std::nullopt;
  }
  const double from = dynamics.linear() ? 0.0 : std::fabs(speed);
  const auto frequencies = stability(linearizationAtRest(dynamics, q, from)).natural_frequencies;
  if (frequencies.empty()) {
    return std::nullopt;
  }
  const double lowest = std::max(frequencies.front(), 1.0e-6 * std::max(1.0, from));
  const double first = std::max(from, 1.0e-2 * lowest);
  const double last = kReach * lowest;
  std::vector<std::pair<double, Eigen::VectorXd>> passed{{from, q}};
  const int strides = dynamics.dof() <= kMostExactCoordinates ? kStrides : kFewerStrides;
  for (int i = 0; i <= strides; ++i) {
    const double high = first * std::pow(last / first, static_cast<double>(i) / strides);
    const auto next = equilibriumNear(dynamics, passed.back().second, high);
    if (!next) {
      return std::nullopt;
    }
    if (!surelyUnstable(linearizationAtRest(dynamics, *next, high))) {
      passed.emplace_back(high, *next);
      continue;
    }
    // What grows too slowly to be sure of has been passed too: Routh's test finds the way back.
    double top = high;
    while (passed.size() > 1 &&
           unstable(linearizationAtRest(dynamics, passed.back().second, passed.back().first))) {
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
      const auto there = equilibriumNear(dynamics, before, middle);
      const bool lost = !there || unstable(linearizationAtRest(dynamics, *there, middle));
      (lost ? top : low) = middle;
    }
    return 0.5 * (low + top);
  }
  return std::nullopt;
}

}  // namespace whirl_twin
