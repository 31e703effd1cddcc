// Looks for systems that their steps no longer follow as accurately as `integrator: auto` promised:
// what a live twin's monitor calls ACCURACY_LOST.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {

class AccuracyWatch {
 public:
  /// Of the chosen systems (indices into the scene) those that say `auto`. The twin outlives it.
  AccuracyWatch(const Twin& twin, const std::vector<std::size_t>& systems);

  /// At the newest record: a warning for each system whose running estimate exceeds its tolerance
  /// for the first time.
  std::vector<std::string> look(const Observer& observer);
  /// [s], simulated, since when; nothing: it has been as accurate all along.
  std::optional<double> lostAt(std::size_t system) const;

 private:
  const Twin& twin_;
  std::vector<std::size_t> watched_;
  std::map<std::size_t, double> lost_;  // since when, by system
};

}  // namespace whirl_twin
