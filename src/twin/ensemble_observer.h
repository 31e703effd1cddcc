// The statistics of a twin's ensembles, for the publisher's thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "messages/states.h"
#include "twin/ensemble.h"
#include "twin/twin.h"

namespace whirl_twin {

// Mean, standard deviation and percentiles of an ensemble.

/// The percentile p [%] of ascending values, with linear interpolation (Hyndman & Fan, The American
/// Statistician 50, 1996, definition 7). NaN if there are none.
double percentile(const std::vector<double>& ascending, double p);

/// Statistics of a record of an ensemble, with its step, but without its time and system.
state::EnsembleState ensembleStatistics(const Ensemble& ensemble, const double* record);

class EnsembleObserver {
 public:
  /// The twin must outlive it. Only one reader of a twin's ensembles at a time.
  explicit EnsembleObserver(Twin& twin);

  /// Systems with an ensemble.
  const std::vector<std::size_t>& systems() const { return systems_; }

  /// The newest statistics of one of systems(), if newer than the last ones; some fifty a simulated
  /// second. `now`: an instant of the twin, from which the stamp of the statistics is computed.
  bool take(std::size_t system, const state::Instant& now, state::EnsembleState& out);

 private:
  Twin& twin_;
  std::vector<std::size_t> systems_;
  std::vector<double> record_;
  std::vector<std::int64_t> last_steps_;  // of each system
};

}  // namespace whirl_twin
