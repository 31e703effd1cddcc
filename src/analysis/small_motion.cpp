#include "analysis/small_motion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/characteristic_polynomial.h"
#include "analysis/equilibria.h"
#include "analysis/routh.h"

namespace whirl_twin {

namespace {

constexpr double kGrowth = 1.0e-9;     // or decay, of the largest eigenvalue: no rounding
constexpr double kRounding = 1.0e-15;  // of the largest eigenvalue: no growth

/// The fastest growth of a deviation, in parts of the largest eigenvalue.
double growth(const SmallMotion& motion) {
  const auto roots = eigenvalues(motion.matrices, motion.zeros);
  const auto fastest = std::max_element(
      roots.begin(), roots.end(), [](const auto& a, const auto& b) { return a.real() < b.real(); });
  return roots.back() == 0.0 ? 0.0 : fastest->real() / std::abs(roots.back());
}

}  // namespace

SmallMotion smallMotionAbout(const Dynamics& dynamics, const CyclicCoordinates& cyclic,
                             const SteadyMotion& motion, double speed) {
  const Linearization l = linearizationAbout(dynamics, motion.q, motion.v, speed);
  return cyclic.any() ? SmallMotion{atFixedMomenta(l, cyclic), cyclic.driven.size()}
                      : SmallMotion{l, 0};
}

std::complex<double> fastestGrowing(const SmallMotion& motion) {
  if (motion.matrices.mass.rows() == 0) {
    return 0.0;
  }
  const auto roots = eigenvalues(motion.matrices, motion.zeros);
  return *std::max_element(roots.begin(), roots.end(),
                           [](const auto& a, const auto& b) { return a.real() < b.real(); });
}

bool surelyUnstable(const SmallMotion& motion) {
  return motion.matrices.mass.rows() > 0 && !cannotGrow(motion.matrices) &&
         growth(motion) > kGrowth;
}

bool GrowthTest::unstable(const SmallMotion& motion) {
  if (motion.matrices.mass.rows() == 0) {
    return false;
  }
  const double fastest = growth(motion);
  if (std::fabs(fastest) > kGrowth) {
    return fastest > 0.0;
  }
  const Linearization& l = motion.matrices;
  if (l.mass.rows() <= most_exact_ && !budget_spent_) {
    try {
      return routh(characteristicPolynomial(l), budget_).verdict == Verdict::kUnstable;
    } catch (const ExactBudgetSpent&) {
      budget_spent_ = true;
    }
  }
  return !cannotGrow(l) && fastest > kRounding;
}

}  // namespace whirl_twin
