// The modes of a running rotor from its ambient vibration (operational modal analysis): the
// synchronous components are subtracted, the residual, excited by noise, is identified at several
// model orders (subspace_identification.h), and poles that are stable over the model order are
// modes (stabilization diagram; B. Peeters, G. De Roeck, J. Dyn. Syst. Meas. Control 123 (2001)).
// Remaining 1X changes the estimated damping by up to ten times in either direction.
//
// The standard deviation of a decay rate s and of a frequency is sqrt(s/T) after a time T at best.
// Modes closer to an order of the shaft than its width are biased by the subtraction: they are
// marked.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

#include "signal/lagged_covariance.h"

namespace whirl_twin {

// A sample of a shaft from several probes: its centre at several stations, and its angle.

struct StationSample {
  std::int64_t index = 0;  ///< increases by one from sample to sample; a gap is a lost sample
  double time = 0.0;       ///< [s]
  std::int64_t turns = 0;  ///< of the shaft, whole, from its phase mark
  double remainder = 0.0;  ///< [rad], and the rest of a turn
  double speed = 0.0;      ///< [rad/s]
  Eigen::VectorXcd z;      ///< [m], x + i y at each station
};

/// Modal assurance criterion: how far two shapes are one, 0 to 1 (R. J. Allemang, D. L. Brown, IMAC
/// 1982).
double modalAssurance(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b);

/// A mode, with standard deviations from parts of the record left out one by one, of frequency and
/// decay not below what theory allows.
struct AmbientMode {
  double frequency = 0.0;  ///< [rad/s]; positive: in the direction of rotation
  double frequency_deviation = 0.0;
  double decay_rate = 0.0;  ///< [1/s]
  double decay_deviation = 0.0;
  double power = 0.0;               ///< [-], its part of the mean square without orders
  Eigen::VectorXcd shape;           ///< [stations], the largest part is 1
  Eigen::VectorXd shape_deviation;  ///< of each part, its real and imaginary parts together
  int order = 0;                    ///< of the shaft, too close to be separated; 0: none

  double size() const { return std::abs(std::complex<double>(decay_rate, frequency)); }
  double dampingRatio() const { return decay_rate / size(); }  ///< [-]
  double logDecrement() const {                                ///< [-]
    return 6.283185307179586 * decay_rate / std::fabs(frequency);
  }
};

struct AmbientRecord {
  double duration = 0.0;   ///< [s], that could be used
  double speed = 0.0;      ///< [rad/s], mean
  double limit = 0.0;      ///< [rad/s], of the frequencies evaluated
  double vibration = 0.0;  ///< [m], root mean square without orders, of one direction of a station
  double orders = 0.0;     ///< [m], root mean square of the synchronous components, likewise
  /// 95 % of an interval lie within so many standard deviations (Student's distribution).
  double interval = 2.0;
  std::vector<AmbientMode> modes;  ///< by rising size of their frequency
};

class AmbientModes {
 public:
  /// Of samples `period` [s] apart at `stations` places, while the shaft turns at about `speed`
  /// [rad/s]; frequencies up to `limit` [rad/s].
  AmbientModes(Eigen::Index stations, double period, double speed, double limit);

  /// Adds the next sample. One that is not finite, is out of sequence or whose speed deviates by
  /// more than 1 % ends the record.
  void take(const StationSample& sample);
  /// The result of all samples so far; nothing before the decimator has put out two hundred
  /// samples.
  std::optional<AmbientRecord> record();

 private:
  void endBlock(bool whole);
  bool takeBlock();
  double turnsInBlock() const;
  std::vector<AmbientMode> identified() const;

  Eigen::Index stations_;
  double period_, speed_, limit_;
  int orders_;
  Decimator decimator_;
  LaggedCovariance covariance_;
  std::vector<StationSample> block_;      // orders not yet removed
  std::optional<std::int64_t> followed_;  // index that continues after a block
  double shortest_block_;                 // [turns], of those that were used
  double order_squares_ = 0.0;            // [m^2], summed over samples and stations
  double speeds_ = 0.0;                   // [rad/s], summed over samples
  std::int64_t samples_ = 0;              // whose orders are removed
};

}  // namespace whirl_twin
