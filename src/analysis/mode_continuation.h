// A whirl mode of a long shaft found from the one that it was where the shaft, or its speed, was a
// little different: Newton's method for (s^2 M + s (C + G) + K + N) phi = 0, which near the
// diagonals costs no more than in proportion to the length (nonlinear inverse iteration: A. Ruhe,
// SIAM J. Numer. Anal. 10, 1973).
#pragma once

#include <optional>

#include "analysis/whirl_modes.h"
#include "mechanics/banded_linearization.h"

namespace whirl_twin {

class ModeContinuation {
 public:
  /// Keeps what it needs of the matrices.
  explicit ModeContinuation(const BandedLinearization& matrices);

  /// The mode that Newton's method comes to from `mode`, its shape not yet normalised. Nothing
  /// where it comes to none that vibrates, or to one whose shape is another: with the energy as
  /// scalar product, correlated by less than `least`. Nothing of a stiffness that is not positive
  /// definite.
  std::optional<WhirlMode> from(const WhirlMode& mode, double least) const;

 private:
  std::complex<double> product(const WhirlMode& a, const WhirlMode& b) const;

  BandedMatrix<double> mass_, by_rate_, by_place_, stiffness_, damping_;
  bool definite_ = false;
  bool cannot_grow_ = false;
};

}  // namespace whirl_twin
