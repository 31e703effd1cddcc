// Pairs measured modes with those of a model by frequency, direction of precession and shape (modal
// assurance criterion, MAC; R. J. Allemang, D. L. Brown, IMAC 1982).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <vector>

#include "analysis/whirl_modes.h"
#include "signal/ambient_modes.h"

namespace whirl_twin {

/// A measured station of a shaft: two probes measure x + i y, a single one the component in its
/// direction.
struct MeasuredStation {
  std::size_t station = 0;         ///< of the rotor's stations
  std::vector<double> direction;   ///< [rad], of its probes
  std::vector<std::size_t> probe;  ///< places among all probes

  bool whole() const { return direction.size() > 1; }
  /// x + i y from two readings; from a single one e^(i direction) times it.
  std::complex<double> z(double first, double second) const;
};

/// Groups probes by station, with these places and directions; of more than two probes at a station
/// the two nearest to a right angle are used.
std::vector<MeasuredStation> measuredStations(const std::vector<std::size_t>& station,
                                              const std::vector<double>& direction);

/// A mode of a model at the measured stations: f e^(i w t) + b e^(-i w t) at each of them.
struct SeenMode {
  double frequency = 0.0;  ///< w [rad/s], damped
  Eigen::VectorXcd forward, backward;
};
SeenMode seenMode(const WhirlMode& mode, const std::vector<MeasuredStation>& stations);

struct ModePair {
  std::size_t measured = 0;
  std::size_t modelled = 0;
  double assurance = 0.0;  ///< [-], modal assurance criterion, 0 to 1
};

/// Pairs each measured mode with at most one of the model's, in order of falling MAC. A mode with
/// elliptical orbits is measured in forward and in backward precession: it may be in two pairs.
/// Frequencies that differ by more than a quarter are not paired.
std::vector<ModePair> pairModes(const std::vector<AmbientMode>& measured,
                                const std::vector<SeenMode>& modelled);

}  // namespace whirl_twin
