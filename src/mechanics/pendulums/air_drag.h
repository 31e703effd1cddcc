// Drag of the air on a point that moves fast enough for it to grow with the square of its speed,
// F = -k |v| v with k = rho c_w A / 2 (H. Schlichting, Boundary-Layer Theory, 1979, ch. 1): above a
// Reynolds number of some hundreds, for a rod of 1 cm from some dm/s on.
#pragma once

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"

namespace whirl_twin {

/// Of D = k |v|^3 / 3, by the square of the speed. At rest its root would have no derivative.
template <class S>
WHIRL_TWIN_INLINE S dragDissipation(double drag, const S& square_of_speed) {
  constexpr double kStill = 1.0e-100;  // (m/s)^2: beside any speed that moves, nothing, in any unit
  const S s = square_of_speed + kStill;
  return (drag / 3.0) * (s * sqrt(s));
}

}  // namespace whirl_twin
