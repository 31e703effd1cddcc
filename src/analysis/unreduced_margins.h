// What a rotor's reduction to a few shapes changes in its stability at a speed: the margins of the
// rotor that it was made of.
//
// Not an estimate. A reduced eigenvalue's residual in the full equations bounds its error only with
// the condition of the eigenvalue, and tells nothing of motions that the shapes have no part in:
// one that grows may be among those left out. So the roots of the full equations themselves are
// looked for (lowest_roots.h), all within the highest speed that the reduction was made for, and
// farther as far as anything can grow (growth_radius.h). Milliseconds for a chain of 50 elements.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "mechanics/dynamics.h"
#include "mechanics/rotors/unreduced_rotor.h"

namespace whirl_twin {

/// Of all motions; of the full rotor those with |s| up to the highest speed of the reduction, the
/// lowest at least, and those that grow.
struct RotorMargins {
  double decay_rate = 0.0;     ///< [1/s], of the slowest; negative: it grows
  double log_decrement = 0.0;  ///< [-], the least; NaN where all are overdamped
  bool grows = false;          ///< beyond what rounding could make
};

struct ReducedMargins {
  RotorMargins reduced, unreduced;
  /// On different sides of the limit: the verdict on the reduced rotor is none on the machine's.
  bool disagree() const { return reduced.grows != unreduced.grows; }
};

class UnreducedMargins {
 public:
  /// Of a rotor in the amplitudes of shapes, with or without local forces and a motor; nothing of
  /// any other. Keeps `dynamics`.
  static std::optional<UnreducedMargins> of(std::shared_ptr<const Dynamics> dynamics);

  /// Of the shapes: how many entries of a place matter.
  Eigen::Index amplitudes() const;
  /// About amplitudes q at rest at a shaft speed [rad/s]; entries of q behind those of the shapes
  /// do not matter. Local forces are those of the place where the full rotor rests next to that.
  /// Throws what stability() does, and RunFailure where it rests nowhere.
  ReducedMargins at(const Eigen::VectorXd& q, double speed) const;

 private:
  UnreducedMargins(std::shared_ptr<const Dynamics> dynamics, const Dynamics& held);

  std::shared_ptr<const Dynamics> dynamics_;
  const Dynamics* held_;  // at a given speed of its shaft
  std::shared_ptr<const UnreducedRotor> rotor_;
  double highest_speed_ = 0.0;
};

}  // namespace whirl_twin
