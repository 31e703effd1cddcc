// Which measured mode is which of a model's, by frequency, sense and shape (the modal assurance
// criterion; R. J. Allemang, D. L. Brown, IMAC 1982).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <vector>

#include "analysis/whirl_modes.h"
#include "signal/ambient_modes.h"

namespace whirl_twin {

/// Where a shaft is measured: two probes show x + i y, one along a direction only what is along it.
struct MeasuredStation {
  std::size_t station = 0;         ///< of the rotor's stations
  std::vector<double> direction;   ///< [rad], of its probes
  std::vector<std::size_t> probe;  ///< their places among all probes

  bool whole() const { return direction.size() > 1; }
  /// x + i y of two readings; of one e^(i direction) times it.
  std::complex<double> z(double first, double second) const;
};

/// The stations of probes at these places in these directions; of more than two probes at a station
/// the two that are nearest to a right angle.
std::vector<MeasuredStation> measuredStations(const std::vector<std::size_t>& station,
                                              const std::vector<double>& direction);

/// A mode of a model as it is measured: f e^(i w t) + b e^(-i w t) at each measured station.
struct SeenMode {
  double frequency = 0.0;  ///< w [rad/s], damped
  Eigen::VectorXcd forward, backward;
};
SeenMode seenMode(const WhirlMode& mode, const std::vector<MeasuredStation>& stations);

struct ModePair {
  std::size_t measured = 0;
  std::size_t modelled = 0;
  double assurance = 0.0;  ///< [-], 0 to 1: how far the shapes are one
};

/// Each measured mode with one of the model's at most, by falling likeness. A mode that runs on
/// ellipses is measured forwards and backwards: it may be in two pairs. Frequencies more than a
/// quarter apart are no pair.
std::vector<ModePair> pairModes(const std::vector<AmbientMode>& measured,
                                const std::vector<SeenMode>& modelled);

}  // namespace whirl_twin
