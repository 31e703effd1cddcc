// Effect of a modal reduction on the stability of a rotor at a speed: the margins of the full-order
// rotor.
//
// Not an estimate. A reduced eigenvalue's residual in the full equations bounds its error only with
// the condition of the eigenvalue, and is no information on motions outside the retained modes: one
// of those may grow. So the roots of the full equations are computed (lowest_roots.h), all within
// the highest speed of the reduction, and beyond up to the bound of the unstable roots
// (unstable_root_bound.h). Milliseconds for a chain of 50 elements.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "mechanics/dynamics.h"
#include "mechanics/rotors/full_order_rotor.h"

namespace whirl_twin {

/// Of all motions; of the full rotor those with |s| up to the highest speed of the reduction, the
/// lowest at least, and those that grow.
struct RotorMargins {
  double decay_rate = 0.0;     ///< [1/s], of the slowest; negative: it grows
  double log_decrement = 0.0;  ///< [-], the smallest; NaN where all are overdamped
  bool grows = false;          ///< beyond what rounding could make
};

struct ReducedMargins {
  RotorMargins reduced, unreduced;
  /// On different sides of the limit: the verdict on the reduced-order rotor is invalid for the
  /// full-order one.
  bool disagree() const { return reduced.grows != unreduced.grows; }
};

class FullOrderMargins {
 public:
  /// Of a rotor in the amplitudes of shapes, with or without local forces and a motor; nothing of
  /// any other. Keeps `dynamics`.
  static std::optional<FullOrderMargins> of(std::shared_ptr<const Dynamics> dynamics);

  /// Of the shapes: how many entries of a place matter.
  Eigen::Index amplitudes() const;
  /// About modal amplitudes q of an equilibrium at a shaft speed [rad/s]; entries of q after those
  /// of the retained modes are ignored. Local forces are those of the full rotor's nearest
  /// equilibrium. Throws what stability() does, and RunFailure where there is no equilibrium.
  ReducedMargins at(const Eigen::VectorXd& q, double speed) const;

 private:
  FullOrderMargins(std::shared_ptr<const Dynamics> dynamics, const Dynamics& held);

  std::shared_ptr<const Dynamics> dynamics_;
  const Dynamics* held_;  // at a given speed of its shaft
  std::shared_ptr<const FullOrderRotor> rotor_;
  double highest_speed_ = 0.0;
};

}  // namespace whirl_twin
