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

/// The percentile p [%] of values in ascending order, linear between them (Hyndman & Fan, The
/// American Statistician 50, 1996, definition 7). NaN of none.
double percentile(const std::vector<double>& ascending, double p);

/// Of one record of an ensemble, with its step, but without its time and system.
state::EnsembleState ensembleStatistics(const Ensemble& ensemble, const double* record);

class EnsembleObserver {
 public:
  /// The twin outlives it. One reader of a twin's ensembles at a time.
  explicit EnsembleObserver(Twin& twin);

  /// The twin's systems that have ensembles.
  const std::vector<std::size_t>& systems() const { return systems_; }

  /// The newest statistics of one of systems(), if there are newer ones than those last taken; some
  /// fifty a simulated second. `now`: an instant of the twin, by which the step of the statistics
  /// gets its stamp.
  bool take(std::size_t system, const state::Instant& now, state::EnsembleState& out);

 private:
  Twin& twin_;
  std::vector<std::size_t> systems_;
  std::vector<double> record_;
  std::vector<std::int64_t> last_steps_;  // of each system
};

}  // namespace whirl_twin
