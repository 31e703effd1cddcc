// Cascade (waterfall) of full spectra of a motion, for a run-up or hours of operation, with
// classified lines.
//
// The window is as long as its lines stay sharp: at an acceleration a [rad/s^2] the speed changes
// by a T while the resolution of a window T is 4 pi / T; both are equal for T = sqrt(4 pi / a).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "signal/orbit_window.h"

namespace whirl_twin {

/// A line of a full spectrum; its frequency is positive in the direction of rotation.
struct SpectrumLine {
  double frequency = 0.0;  ///< [rad/s]
  double amplitude = 0.0;  ///< [m]
  double ratio = 0.0;      ///< [-], of its size to that of the speed; NaN at standstill
  int order = 0;           ///< 1: 1X, 2: 2X, ...; 0: no integer order

  /// It is slower than the shaft: oil whirl, whip, a rub, free vibration.
  bool subsynchronous() const { return order == 0 && ratio < 1.0; }
};

/// The full spectrum of a window, without its mean.
struct WindowSpectrum {
  double begin = 0.0, end = 0.0;    ///< [s], of the window
  double speed = 0.0;               ///< [rad/s], of the shaft, at its middle
  double smear = 0.0;               ///< [rad/s], by which the speed changed in it
  double resolution = 0.0;          ///< [rad/s], smallest distance of separable lines
  double first = 0.0, step = 0.0;   ///< [rad/s], frequency of the first amplitude, and to the next
  std::vector<float> amplitude;     ///< [m], a circle has its radius
  std::vector<SpectrumLine> lines;  ///< largest first, from a hundredth of the largest on

  double frequency(std::size_t i) const { return first + step * static_cast<double>(i); }
};

class SpectrumCascade {
 public:
  /// Takes the next sample. Samples that are missing begin a new window, an index that goes back a
  /// new cascade; what is not finite is missing.
  void take(const OrbitSample& sample);

  /// As time went on, evenly apart: 48 to 96 of them from some length on.
  const std::vector<WindowSpectrum>& spectra() const { return spectra_; }
  /// Of the window that ends with the newest sample; none where the samples are too few, or too
  /// far apart to see the shaft turn.
  std::optional<WindowSpectrum> latest() const;

 private:
  std::deque<OrbitSample> kept_;  // evenly apart
  std::int64_t stride_ = 0;       // from index to index
  std::vector<WindowSpectrum> spectra_;
  double due_ = 0.0;    // [s]
  double every_ = 0.0;  // [s]
};

}  // namespace whirl_twin
