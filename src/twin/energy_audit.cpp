#include "twin/energy_audit.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

void EnergyAudit::observe(const Energies& energies, double work) {
  if (!started_) {
    started_ = true;
    start_ = energies.jacobi - work;
  }
  scale_ = std::max(scale_, std::fabs(energies.kinetic) + std::fabs(energies.potential));
  residual_ = scale_ > 0.0 ? (energies.jacobi - start_ - work) / scale_ : 0.0;
}

}  // namespace whirl_twin
