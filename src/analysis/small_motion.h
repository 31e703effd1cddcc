// A small motion about a steady one, reduced to what its stability hangs on, and the verdict on it
// that searches ask for again and again: by the eigenvalues where they leave no doubt, by Routh's
// test where they do.
#pragma once

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

/// The last `zeros` coordinates do not matter: their zero eigenvalues are set aside.
struct SmallMotion {
  Linearization matrices;
  std::size_t zeros = 0;
  /// Where coefficients repeat: what decides, and not the matrices, which are of the mean loads.
  std::optional<PeriodicMotion> periodic = std::nullopt;
};

/// About a steady motion at a shaft speed [rad/s]: without the rigid-body modes of a linear system,
/// whose zeros rounding would scatter, and with the conserved momenta of any other as they are.
/// Nothing where coefficients repeat and no periodic motion was found from `near`, or else from the
/// steady one, on.
std::optional<SmallMotion> smallMotionAbout(
    const Dynamics& dynamics, const CyclicCoordinates& cyclic, const SteadyMotion& motion,
    double speed, const std::optional<PeriodicMotion>& near = std::nullopt);

/// The root with the largest real part [1/s]; 0 where nothing is left that could move.
std::complex<double> fastestGrowing(const SmallMotion& motion);

/// Grows beyond what the rounding of eigenvalues could make.
bool surelyUnstable(const SmallMotion& motion);

/// Tells stable from unstable at the places of one search. Beyond `most_exact` coordinates, or
/// where exact numbers become too long, by the eigenvalues alone.
class GrowthTest {
 public:
  explicit GrowthTest(Eigen::Index most_exact = kMostExactCoordinates) : most_exact_(most_exact) {}
  bool unstable(const SmallMotion& motion);

 private:
  Eigen::Index most_exact_;
  ExactBudget budget_{1.0e9};  ///< products, of all exact tests of a search
  bool budget_spent_ = false;
};

}  // namespace whirl_twin
