// Decay rate of the least damped free vibration of a running rotor, from its motion alone: the
// synchronous components are subtracted, and the residual, excited by ambient noise, is identified
// (subspace_identification.h). Slow: the standard deviation of a decay rate s is sqrt(s/T) after a
// time T at best, a fifth of s after 25/s: suitable for the audit of a model, not as a fast alarm.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

#include "signal/orbit_window.h"

namespace whirl_twin {

struct AuditedDecay {
  double time = 0.0;        ///< [s], of the newest sample
  double frequency = 0.0;   ///< [rad/s]; positive: in the direction of rotation
  double decay_rate = 0.0;  ///< [1/s]
  /// Standard deviation of the decay rate [1/s], from parts of the record left out one by one, and
  /// not below what theory allows.
  double deviation = 0.0;
  double vibration = 0.0;  ///< [m], root mean square of the identified residual, in one direction
};

class DecayAudit {
 public:
  /// Of records `window` [s] long, with a result every quarter of it.
  explicit DecayAudit(double window) : window_(window) {}

  /// Adds the next sample; returns the result of a record that it completes. None where the speed
  /// has changed by more than 1 % in the record, where samples are missing, where the motion is
  /// purely synchronous, or where no mode is found.
  std::optional<AuditedDecay> take(const OrbitSample& sample);
  void clear();

 private:
  void removeOrders();
  std::optional<AuditedDecay> audited() const;

  double window_;
  std::vector<OrbitSample> block_;          // samples, orders not yet removed
  std::vector<std::complex<double>> rest_;  // [m], orders removed
  std::vector<double> sizes_;               // [m^2], mean square of each block with its orders
  double step_ = 0.0;                       // [s]
  double speed_ = 0.0;                      // [rad/s], at the start of the record
  std::int64_t next_ = 0;                   // index expected
  std::size_t since_report_ = 0;            // samples
};

}  // namespace whirl_twin
