// Full spectrum: forward and backward components of a motion z = x + i y over frequency. A complex
// Fourier transform retains the sense of rotation, which the spectrum of one probe does not
// contain.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <optional>
#include <vector>

namespace whirl_twin {

class FullSpectrum {
 public:
  /// Of samples `period` [s] apart, weighted by a Hann window: a circle of radius r is a line of
  /// height r. The caller removes a mean or trend.
  FullSpectrum(const Eigen::ArrayXcd& z, double period);

  std::size_t size() const { return line_.size(); }
  /// [rad/s], rising from -pi/period; positive: from x towards y.
  double frequency(std::size_t bin) const;
  double amplitude(std::size_t bin) const { return line_[bin]; }  ///< [m]
  double resolution() const {
    return resolution_;
  }  ///< [rad/s], smallest distance of separable
     ///< lines

  struct Peak {
    double frequency = 0.0;  ///< [rad/s], between the bins
    double amplitude = 0.0;  ///< [m]
    /// Its power relative to the mean of all bins; below 12 it is likely to be noise.
    double prominence = 0.0;
  };
  /// The highest peak among the frequencies that pass.
  std::optional<Peak> highest(const std::function<bool(double frequency)>& pass) const;

  /// Of which sense the motion is at all, weighted by the area that each line sweeps: 1 where every
  /// line runs in the direction of `speed`, -1 where none does.
  double precession(double speed) const;

 private:
  double step_;        // [rad/s], from bin to bin
  double resolution_;  // [rad/s]
  std::vector<double> line_;
};

}  // namespace whirl_twin
