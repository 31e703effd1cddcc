// For how long a whirl is sure to turn with its shaft, or to stand beside its centre: so long its
// phase need not be looked at.
//
// At constant speed a linear rotor, M q'' + (C + G) q' + (K + N) q = f_0 + Re[F e^(i theta)], moves
// as q = s + Re[X e^(i theta)] + e. The sag s and the response X (synchronous_response.h) are
// known; e is free, no longer in its energy than |y(0)| e^(mu t), and at a station no further out
// than r |y| (free_motion.h). So
//
//   z = z_s + f e^(i theta) + b e^(-i theta) + z_e,   |z_e| <= r |y(0)| e^(mu t),
//
// and while |f| > |z_s| + |b| + |z_e| the whirl stays within a quarter of a turn of f e^(i theta):
// its lag never leaves that half turn, whatever number of turns go by. Likewise about z_s.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "mechanics/dynamics.h"
#include "twin/free_motion.h"
#include "twin/whirl_phase.h"

namespace whirl_twin {

/// Of one rotor at one speed.
class SteadyWhirl {
 public:
  /// nullopt: nothing is known, as where a stiffness is not positive, at an undamped resonance, for
  /// what turns twice a turn, or where neither the response nor the sag is ahead at a station.
  static std::optional<SteadyWhirl> of(const Dynamics& dynamics,
                                       const std::vector<Station>& stations, double speed);

  double speed() const { return speed_; }  ///< [rad/s]
  /// [s] from the state q, v, at the shaft's angle [rad], for which the whirl keeps() at every
  /// station, if nothing else acts; 0: not even now.
  double lasts(const double* q, const double* v, double angle) const;
  /// What a station's whirl keeps in the meantime.
  Kept keeps(std::size_t station) const { return stations_[station].keeps; }
  /// [m], at least that far out it is then.
  double leastRadius(std::size_t station) const { return stations_[station].least_radius; }

 private:
  struct StationBound {
    Kept keeps = Kept::kLag;
    double largest_free = 0.0;  ///< |y|, up to which the free motion leaves the rest ahead
    double least_radius = 0.0;  ///< [m]
  };

  SteadyWhirl() = default;
  std::optional<StationBound> bound(const Station& station) const;

  double speed_ = 0.0;
  std::optional<FreeMotion> free_;
  Eigen::VectorXd sag_;        ///< s
  Eigen::VectorXcd response_;  ///< X
  std::vector<StationBound> stations_;
};

}  // namespace whirl_twin
