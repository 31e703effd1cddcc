#include "analysis/small_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "analysis/characteristic_polynomial.h"
#include "analysis/equilibria.h"
#include "analysis/quartic.h"
#include "analysis/routh.h"

namespace whirl_twin {

namespace {

constexpr double kGrowth = 1.0e-9;  // or decay, of the largest eigenvalue: no rounding
constexpr double kClear = 1.0e-5;   // likewise, whatever a quartic's coefficients have lost
constexpr double kGrowthRounding = 1.0e-15;  // of the largest eigenvalue: no growth

/// The characteristic quartic of two coordinates.
std::array<double, 5> quarticOf(const Linearization& l) {
  const Eigen::Matrix2d m = l.mass, c = l.damping + l.gyroscopic, k = l.stiffness + l.circulatory;
  const auto determinant = [](double m11, double c11, double k11, double m22, double c22,
                              double k22) {
    return std::array<double, 5>{m11 * m22, m11 * c22 + c11 * m22,
                                 m11 * k22 + c11 * c22 + k11 * m22, c11 * k22 + k11 * c22,
                                 k11 * k22};
  };
  std::array<double, 5> quartic = determinant(m(0, 0), c(0, 0), k(0, 0), m(1, 1), c(1, 1), k(1, 1));
  const std::array<double, 5> across =
      determinant(m(0, 1), c(0, 1), k(0, 1), m(1, 0), c(1, 0), k(1, 0));
  for (std::size_t i = 0; i < quartic.size(); ++i) {
    quartic[i] -= across[i];
  }
  return quartic;
}

/// The fastest growth of a deviation, in parts of the largest eigenvalue: to some digits where it
/// is far from none.
double growth(const SmallMotion& motion) {
  if (motion.matrices.mass.rows() == 2 && motion.zeros == 0) {
    const QuarticJudgement quick = judgeQuartic(quarticOf(motion.matrices));
    const double found = quick.rightmost.real() / quick.largest;
    if (quick.factored && quick.sure && std::fabs(found) > kClear &&
        (found > 0.0) == (quick.right > 0)) {
      return found;
    }
  }
  const auto roots = eigenvalues(motion.matrices, motion.zeros);
  const auto fastest = std::max_element(
      roots.begin(), roots.end(), [](const auto& a, const auto& b) { return a.real() < b.real(); });
  return roots.back() == 0.0 ? 0.0 : fastest->real() / std::abs(roots.back());
}

}  // namespace

std::optional<SmallMotion> smallMotionAbout(const Dynamics& dynamics,
                                            const CyclicCoordinates& cyclic,
                                            const SteadyMotion& motion, double speed,
                                            const std::optional<PeriodicMotion>& near) {
  const Linearization l = linearizationAbout(dynamics, motion.q, motion.v, speed);
  SmallMotion small = cyclic.any() ? SmallMotion{atFixedMomenta(l, cyclic), cyclic.driven.size()}
                                   : SmallMotion{l, 0};
  if (const auto period = timeDependence(dynamics, speed).period) {
    small.periodic = periodicMotionNear(dynamics, speed, *period,
                                        near ? SteadyMotion{near->q, near->v} : motion);
    if (!small.periodic) {
      return std::nullopt;
    }
  }
  return small;
}

std::complex<double> fastestGrowing(const SmallMotion& motion) {
  if (motion.matrices.mass.rows() == 0) {
    return 0.0;
  }
  const auto roots = motion.periodic ? exponentsOf(*motion.periodic, eigenvalues(motion.matrices))
                                     : eigenvalues(motion.matrices, motion.zeros);
  return *std::max_element(roots.begin(), roots.end(),
                           [](const auto& a, const auto& b) { return a.real() < b.real(); });
}

bool surelyUnstable(const SmallMotion& motion) {
  if (motion.periodic) {
    return grows(*motion.periodic);
  }
  return motion.matrices.mass.rows() > 0 && !cannotGrow(motion.matrices) &&
         growth(motion) > kGrowth;
}

bool GrowthTest::unstable(const SmallMotion& motion) {
  if (motion.periodic) {
    return grows(*motion.periodic);
  }
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
  return !cannotGrow(l) && fastest > kGrowthRounding;
}

}  // namespace whirl_twin
