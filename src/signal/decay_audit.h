// How fast the free vibration of a running rotor that lasts longest decays, from its motion alone:
// what turns with the shaft is taken away, and the rest, which ambient noise excites, is identified
// (subspace_identification.h). Slow: a decay rate s is known to sqrt(s/T) after a time T at best,
// to a fifth after 25/s, so that it audits a model and is no alarm that has to be fast.
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
  double vibration = 0.0;  ///< [m], root mean square of what it was told from, in one direction
};

class DecayAudit {
 public:
  /// Of records `window` [s] long, told every quarter of it.
  explicit DecayAudit(double window) : window_(window) {}

  /// Takes the next sample; the result of a record that it completes. None where the speed has
  /// changed by more than 1 % in it, where samples are missing, where the motion turns with the
  /// shaft and nothing else is there, or where no mode is found.
  std::optional<AuditedDecay> take(const OrbitSample& sample);
  void clear();

 private:
  void removeOrders();
  std::optional<AuditedDecay> told() const;

  double window_;
  std::vector<OrbitSample> block_;          // samples, orders not yet removed
  std::vector<std::complex<double>> rest_;  // [m], orders removed
  std::vector<double> sizes_;               // [m^2], mean square of each block with its orders
  double step_ = 0.0;                       // [s]
  double speed_ = 0.0;                      // [rad/s], at the start of the record
  std::int64_t next_ = 0;                   // index expected
  std::size_t since_told_ = 0;              // samples
};

}  // namespace whirl_twin
