// A linear rotor by its banded matrices, whose cost is linear in the length of a chain of nodes.
#pragma once

#include <memory>

#include "mechanics/linear_rotor.h"
#include "mechanics/linearization.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

class BandedRotor {
 public:
  explicit BandedRotor(const LinearRotor& rotor) : dense_(rotor.matrices) {
    if (const auto* assembled = rotor.matrices.target<AssembledMatrices>()) {
      assembly_ = assembled->assembly;
    }
  }

  /// At a constant speed [rad/s].
  BandedLinearization matrices(double speed) const {
    return assembly_ ? assembly_->bandedMatrices(speed) : banded(dense_(speed));
  }

 private:
  std::function<Linearization(double)> dense_;
  std::shared_ptr<const RotorAssembly> assembly_;  // none: another rotor
};

/// K + N - w^2 M + i w (C + G) at a speed w [rad/s].
inline BandedMatrix<std::complex<double>> synchronousStiffness(const BandedLinearization& l,
                                                               double speed) {
  BandedMatrix<std::complex<double>> d(l.size(), 0);
  d.add(1.0, l.stiffness);
  d.add(1.0, l.circulatory);
  d.add(-speed * speed, l.mass);
  const std::complex<double> rate(0.0, speed);
  d.add(rate, l.damping);
  d.add(rate, l.gyroscopic);
  return d;
}

}  // namespace whirl_twin
