// Stability of a quartic, the characteristic polynomial of two coordinates, in well under a
// microsecond: Routh's first column in doubles, with a bound of its rounding, and the margins from
// its two quadratic factors (Ferrari's resolvent, refined by Newton's method on the factors).
// Inconclusive cases are marked and left to routh() and roots(), which are exact and slow.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/exact_number.h"
#include "analysis/floquet.h"
#include "analysis/stability.h"
#include "analysis/steady_motion.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

struct QuarticJudgement {
  bool sure = false;  ///< of `right`: no rounding could change it
  int right = 0;      ///< roots right of the imaginary axis; where it is sure none lies on it

  bool factored = false;           ///< what follows holds, to the condition of the roots
  std::complex<double> rightmost;  ///< [1/s], Im >= 0
  double largest = 0.0;            ///< [1/s], |s| of the root farthest out
  double decay_rate = 0.0;         ///< [1/s], -max Re s
  double damping_ratio = 0.0;      ///< [-], min of -Re s / |s|
};

/// Coefficients highest power first. Real-time safe.
QuarticJudgement judgeQuartic(const std::array<double, 5>& coefficients) noexcept;

// Linearized motion about a steady one, reduced to the coordinates that its stability depends on,
// and the repeated stability test of searches: by the eigenvalues where they are conclusive, else
// by Routh's test.

/// The last `zeros` coordinates do not matter: their zero eigenvalues are set aside.
struct LinearizedMotion {
  Linearization matrices;
  std::size_t zeros = 0;
  /// Where coefficients repeat: what decides, and not the matrices, which are of the mean loads.
  std::optional<PeriodicMotion> periodic = std::nullopt;
};

/// About a steady motion at a shaft speed [rad/s]: without the rigid-body modes of a linear system,
/// whose zeros rounding would scatter, and at constant conserved momenta of any other. Nothing
/// where coefficients are periodic and no periodic motion was found from `near`, or else from the
/// steady one.
std::optional<LinearizedMotion> linearizedMotionAbout(
    const Dynamics& dynamics, const CyclicCoordinates& cyclic, const SteadyMotion& motion,
    double speed, const std::optional<PeriodicMotion>& near = std::nullopt);

/// The root with the largest real part [1/s]; 0 where no coordinate can move.
std::complex<double> fastestGrowing(const LinearizedMotion& motion);

/// Grows beyond what the rounding of eigenvalues could make.
bool surelyUnstable(const LinearizedMotion& motion);

/// Stability test at the points of one search. Beyond `most_exact` coordinates, or where exact
/// numbers become too long, by the eigenvalues alone.
class GrowthTest {
 public:
  explicit GrowthTest(Eigen::Index most_exact = kMaxExactCoordinates) : most_exact_(most_exact) {}
  bool unstable(const LinearizedMotion& motion);

 private:
  Eigen::Index most_exact_;
  ExactBudget budget_{1.0e9};  ///< products, of all exact tests of a search
  bool budget_spent_ = false;
};

}  // namespace whirl_twin
