// The modes of a running rotor from its ambient vibration (operational modal analysis): what turns
// with the shaft is taken away, the rest, which noise excites, is identified at several model
// orders (subspace_identification.h), and what stays where it is from order to order is a mode
// (stabilization; B. Peeters, G. De Roeck, J. Dyn. Syst. Meas. Control 123 (2001)). 1X left in
// makes a rotor look less damped, or more, by ten times.
//
// A decay rate s and a frequency are known to sqrt(s/T) after a time T at best. Modes closer to an
// order of the shaft than it is wide are changed by what is taken away: they are marked.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

#include "signal/lagged_covariance.h"

namespace whirl_twin {

// What probes show of a whole shaft at an instant: its centre at several stations, and where it
// stands itself.

struct StationSample {
  std::int64_t index = 0;  ///< rises by one from sample to sample; a hole is a sample that is lost
  double time = 0.0;       ///< [s]
  std::int64_t turns = 0;  ///< of the shaft, whole, from its phase mark
  double remainder = 0.0;  ///< [rad], and the rest of a turn
  double speed = 0.0;      ///< [rad/s]
  Eigen::VectorXcd z;      ///< [m], x + i y at each station
};

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
  int order = 0;                    ///< of the shaft, that is too close to tell it from; 0: none

  double size() const { return std::abs(std::complex<double>(decay_rate, frequency)); }
  double dampingRatio() const { return decay_rate / size(); }  ///< [-]
  double logDecrement() const {                                ///< [-]
    return 6.283185307179586 * decay_rate / std::fabs(frequency);
  }
};

struct AmbientRecord {
  double duration = 0.0;   ///< [s], that could be used
  double speed = 0.0;      ///< [rad/s], mean
  double limit = 0.0;      ///< [rad/s], of the frequencies looked at
  double vibration = 0.0;  ///< [m], root mean square without orders, of one direction of a station
  double orders = 0.0;     ///< [m], root mean square of what turned with the shaft, likewise
  /// 95 % of an interval lie within so many standard deviations (Student's distribution).
  double interval = 2.0;
  std::vector<AmbientMode> modes;  ///< by rising size of their frequency
};

class AmbientModes {
 public:
  /// Of samples `period` [s] apart at `stations` places, while the shaft turns at about `speed`
  /// [rad/s]; frequencies up to `limit` [rad/s].
  AmbientModes(Eigen::Index stations, double period, double speed, double limit);

  /// The next sample. One that is not finite, that does not follow or whose speed is off by more
  /// than 1 % ends what is looked at together.
  void take(const StationSample& sample);
  /// What can be told of all that has come; nothing where that is less than the time in which two
  /// hundred samples come out of the decimator.
  std::optional<AmbientRecord> told();

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
  std::optional<std::int64_t> followed_;  // index that goes on after a block
  double shortest_block_;                 // [turns], of those that were used
  double order_squares_ = 0.0;            // [m^2], summed over samples and stations
  double speeds_ = 0.0;                   // [rad/s], summed over samples
  std::int64_t samples_ = 0;              // whose orders are removed
};

}  // namespace whirl_twin
