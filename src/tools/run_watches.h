// Looks for systems that their steps no longer follow as accurately as `integrator: auto` promised:
// what a live twin's monitor calls ACCURACY_LOST.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/validity.h"
#include "reports/output.h"
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

// Warns when the equations of a system stop describing its machine, once for each condition.

class ValidityWatch {
 public:
  ValidityWatch(const Twin& twin, const std::vector<std::size_t>& systems);

  /// Is there a condition that any step can break?
  bool watches() const { return !watched_.empty(); }
  /// Looks at the newest step. Returns a sentence for each condition that broke in it for the
  /// first time.
  std::vector<std::string> look(const Observer& observer);

  /// [{condition, meaning, unit, first_time, worst_margin}] of those that broke.
  Json json(std::size_t system) const;

 private:
  struct Breach {
    Condition condition;  ///< at its worst
    double first_time;    ///< [s], simulated
  };

  const Twin& twin_;
  std::vector<std::size_t> watched_;  ///< systems that have conditions
  std::map<std::size_t, std::map<std::string, Breach>> breaches_;
};

}  // namespace whirl_twin
