// An active magnetic bearing: along x, and so along y, two poles that pull against each other, each
// at the bias current i0 and the gap s0, driven by a control current i (G. Schweitzer, E. Maslen,
// Magnetic Bearings, 2009, ch. 4):
//
//   f = k ((i0 + i) / (s0 - x))^2 - k ((i0 - i) / (s0 + x))^2
//     = ki i + ks x + ...,   ki = 4 k i0 / s0^2,   ks = 4 k i0^2 / s0^3 = ki i0 / s0
//
// A pole's current is never negative: beyond |i| = i0 one of them is off. The force of a pole is
// limited by the saturation of its iron.
#pragma once

#include "mechanics/local_force.h"

namespace whirl_twin {

class MagneticBearing final : public NodalForceLaw {
 public:
  /// Of an axis.
  struct Force {
    double force;                 ///< [N]
    double by_current, by_place;  ///< [N/A], [N/m]: its derivatives
    double both;                  ///< [N], of both poles without their sign
  };

  /// ki [N/A] at the bias [A] and the gap [m]; saturation [N] of a pole, infinite: none.
  MagneticBearing(double ki, double bias, double gap, double saturation);

  double ki() const { return ki_; }                 ///< [N/A]
  double ks() const { return ki_ * bias_ / gap_; }  ///< [N/m], pulling away from the middle

  // Real-time safe.

  /// f, with the linear part, for a current [A] and |place| < gap [m].
  Force axis(double current, double place) const noexcept;
  /// f less its linear part.
  bool push(const LocalState& at, NodalForce& out) const noexcept override;

  LocalSlopes slopes(const LocalState& at) const noexcept override;
  double room(const Eigen::Vector2d& place) const noexcept override;
  double length() const override;

 private:
  struct Pole {
    double force, by_current, by_gap;  ///< by_gap: as the gap closes
  };
  Pole pole(double current, double gap) const noexcept;

  double ki_, bias_, gap_, saturation_;
  double k_;  ///< [N m^2/A^2]
};

}  // namespace whirl_twin
