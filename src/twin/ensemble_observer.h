// The statistics of a twin's ensembles, for the publisher's thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "messages/states.h"
#include "twin/twin.h"

namespace whirl_twin {

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
