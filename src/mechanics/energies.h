// The energies of a system at a state, and the powers that change them.
#pragma once

namespace whirl_twin {

struct Energies {
  double kinetic = 0.0;           ///< [J], T
  double potential = 0.0;         ///< [J], V
  double jacobi = 0.0;            ///< [J], h = v . dL/dv - L
  double dissipated_power = 0.0;  ///< [W], v . dD/dv
  double input_power = 0.0;       ///< [W], Q . v - dL/dt|explicit
};

}  // namespace whirl_twin
