// Campbell diagram: the whirl frequencies of a linear rotor over its speed, each mode followed by
// its shape through every crossing, and the speeds at which a multiple of the speed meets them
// (W. Campbell, Trans. ASME 46, 1924): Im s(w) = h w.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/mode_tracking.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

/// One mode at one speed; numbers are NaN where it does not vibrate.
struct CampbellPoint {
  double frequency = 0.0;          ///< [rad/s], damped
  double natural_frequency = 0.0;  ///< [rad/s], |s|
  double decay_rate = 0.0;         ///< [1/s], -Re s; negative: it grows
  double damping_ratio = 0.0;      ///< [-]
  double log_decrement = 0.0;      ///< [-]
  Whirl whirl = Whirl::kForward;
};

struct CampbellCrossing {
  std::size_t branch = 0;
  double harmonic = 1.0;  ///< h, of the speed
  double speed = 0.0;     ///< [rad/s]
  CampbellPoint mode;     ///< there
  bool slows = true;      ///< slower than h w beyond; false: it outruns h w
};

struct CampbellDiagram {
  std::vector<double> speeds;                        ///< [rad/s]
  std::vector<std::vector<CampbellPoint>> branches;  ///< each at every speed
  std::vector<CampbellCrossing> crossings;           ///< by harmonic, then by speed
};

struct CampbellRequest {
  std::vector<double> speeds;             ///< [rad/s], ascending
  std::vector<double> harmonics = {1.0};  ///< of the speed
  std::size_t branches = 12;              ///< the modes of lowest frequency at the first speed
  /// Called after each speed, with how many are done.
  std::function<void(std::size_t)> progress = {};
};

/// Crossings are those of whirls (isWhirl: damping ratios up to 0.7), refined to the last digits of
/// the eigenvalues, and counted without mode tracking (crossing_search.h): a crossing that tracking
/// misses is added, on the lost branch or, also for a mode that is not among the lowest, on a
/// separate one.
CampbellDiagram campbell(const LinearRotor& rotor, const std::vector<Station>& stations,
                         const CampbellRequest& request);

CampbellPoint campbellPoint(const std::optional<WhirlMode>& mode);

}  // namespace whirl_twin
