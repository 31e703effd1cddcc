// The lowest eigenvalues of a rotor with many coordinates, and a stability proof for the others.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "analysis/lowest_roots.h"
#include "mechanics/linearization.h"

namespace whirl_twin {

/// A real part below this part of |s| may be rounding: the energy of the shape decides [-].
inline constexpr double kDoubtfulRealPart = 1.0e-8;

/// A damping ratio by the energy below this is the rounding of the shape, squared [-].
inline constexpr double kNoDamping = 1.0e-18;

struct LowestEigenvalues {
  std::vector<std::complex<double>> roots;  ///< [1/s], by rising |s|, then Im
  std::size_t omitted = 0;                  ///< all of larger modulus
  bool omitted_are_sure = false;            ///< it is proved that none of them grows
  bool undamped = false;  ///< nothing dissipates and nothing feeds: all lie on the axis
};

/// s^2 M + s (C + G) + K + N.
BandedPencil<double> pencilOf(const BandedLinearization& matrices);

/// -Re s [1/s] by the energy that the shape dissipates and is fed (unstable_root_bound.h), which
/// has no part in the rounding of s.
double decayByEnergy(const BandedLinearization& matrices, const RefinedEigenpair& root);

/// Of the lowest `modes`, two each; of more where the proof that no other grows requires them and
/// one of them does. Small real parts are computed from the energy; without damping and circulatory
/// forces, exactly 0. Nothing where lowestRoots() has no result.
std::optional<LowestEigenvalues> lowestEigenvalues(const BandedLinearization& matrices,
                                                   std::size_t modes);

/// Likewise those within a circle of at least this radius [1/s], and beyond it those that grow.
std::optional<LowestEigenvalues> eigenvaluesWithin(const BandedLinearization& matrices,
                                                   double radius);

}  // namespace whirl_twin
