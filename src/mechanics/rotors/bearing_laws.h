// Bearings whose coefficients follow the shaft's speed: a table of measured or computed
// coefficients, and a short journal bearing under its load.
//
// A table is interpolated by piecewise cubics with Fritsch and Butland's slopes (SIAM J. Sci. Stat.
// Comput. 5, 1984): once differentiable and without overshoot, so that no stiffness or damping that
// is positive at two speeds is negative between them. Outside, its first or last row holds.
#pragma once

#include <vector>

#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

struct BearingRow {
  double speed = 0.0;  ///< [rad/s]
  BearingCoefficients coefficients;
};

/// Rows by rising speed, one at least. Throws std::logic_error if speeds do not rise.
SpeedBearing tabulatedBearing(int node, const std::vector<BearingRow>& rows);

/// Under a load [N] along -y. Slower than its film carries that at an eccentricity of 0.95 the
/// journal touches, and its coefficients are a guess.
SpeedBearing journalBearing(int node, const ShortJournalBearing& bearing, double load);

}  // namespace whirl_twin
