// The energy balance of a system over its records: what h = v dL/dv - L has gained beyond the work
// that the steps have audited, in parts of the largest energy in play so far.
#pragma once

#include "mechanics/dynamics.h"

namespace whirl_twin {

class EnergyAudit {
 public:
  /// The next record; the first one is the start.
  void observe(const Energies& energies, double work);
  double residual() const { return residual_; }  ///< [-]

 private:
  bool started_ = false;
  double start_ = 0.0;     // [J], h less the work
  double scale_ = 0.0;     // [J], largest T + |V| so far
  double residual_ = 0.0;  // [-]
};

}  // namespace whirl_twin
