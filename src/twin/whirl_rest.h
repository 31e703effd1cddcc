// For how long a whirl is sure to stay within half a turn of where it is, while the speed of its
// shaft changes: so long it need not be looked at.
//
// With matrices that do not depend on the speed, and with e = q - s about the sag s, the rates of
// FreeMotion's length |y| (free_motion.h) are bounded by what the shaft's forces can do:
//
//   |y(t)| <= (|y(0)| + g t) e^(mu t),   g = g_0 + g_1 (w^2 + |a|),
//
// where w and a are the largest speed and acceleration in the meantime. A station is moved from
// z(0) by less than s e^(mu t) (|y(0)| t + g t^2 / 2). While that is less than a part of |z(0)| the
// whirl stays on its side of the centre. And the straight line z(0) + z'(0) t, which goes round the
// centre by less than a quarter of a turn and hardly nears it unless it is aimed at it, is left by
// less than s e^(mu t) (k (|y(0)| + g t / 3) + g) t^2 / 2: while that is less than a part of its
// distance from the centre, the whirl goes round by less than half a turn. The longer one counts.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mechanics/dynamics.h"
#include "twin/free_motion.h"

namespace whirl_twin {

class WhirlRest {
 public:
  /// nullopt: where matrices depend on the speed, or nothing is known (FreeMotion::of()).
  static std::optional<WhirlRest> of(const Dynamics& dynamics,
                                     const std::vector<Station>& stations);

  /// [s] from the state q, v, up to `longest`, in which the shaft is nowhere faster than `speed`
  /// [rad/s] nor speeds up by more than `acceleration` [rad/s^2]; 0: not even now. From one step
  /// [s] to the next its mark and the whirl together stay below half a turn.
  double lasts(const double* q, const double* v, double speed, double acceleration, double step,
               double longest) const;

 private:
  struct Place {
    Eigen::VectorXd along_x, along_y;
    double fastest;  ///< s
  };

  WhirlRest() = default;

  std::optional<FreeMotion> free_;
  Eigen::VectorXd sag_;
  double steady_push_ = 0.0;    ///< g_0
  double inertial_push_ = 0.0;  ///< g_1
  std::vector<Place> places_;
};

}  // namespace whirl_twin
