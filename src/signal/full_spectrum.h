// The full spectrum: what of a motion z = x + i y goes round forwards and what backwards, by
// frequency. A complex Fourier transform keeps the sign that a spectrum of one probe loses.
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
  /// height r. A mean or trend is the caller's to take away.
  FullSpectrum(const Eigen::ArrayXcd& z, double period);

  std::size_t size() const { return line_.size(); }
  /// [rad/s], rising from -pi/period; positive: from x towards y.
  double frequency(std::size_t bin) const;
  double amplitude(std::size_t bin) const { return line_[bin]; }  ///< [m]
  double resolution() const { return resolution_; }  ///< [rad/s], between lines that are told apart

  struct Peak {
    double frequency = 0.0;  ///< [rad/s], between the bins
    double amplitude = 0.0;  ///< [m]
    /// Its power beside the mean of all bins; below 12 it is likely to be noise.
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
