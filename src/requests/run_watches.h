// Accuracy watch during a run: detects systems whose error exceeds the bound of `integrator: auto`;
// a live twin's monitor raises ACCURACY_LOST for that.
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
  /// Of the chosen systems (indices into the scene) those with `auto`. The twin outlives it.
  AccuracyWatch(const Twin& twin, const std::vector<std::size_t>& systems);

  /// Evaluates the newest record: a warning for each system whose running error estimate exceeds
  /// its tolerance for the first time.
  std::vector<std::string> look(const Observer& observer);
  /// [s], simulated time of the loss; empty: accurate all along.
  std::optional<double> lostAt(std::size_t system) const;

 private:
  const Twin& twin_;
  std::vector<std::size_t> watched_;
  std::map<std::size_t, double> lost_;  // since when, by system
};

// Warns when the model of a system leaves its range of validity, once for each condition.

class ValidityWatch {
 public:
  ValidityWatch(const Twin& twin, const std::vector<std::size_t>& systems);

  /// Are there any conditions to watch?
  bool watches() const { return !watched_.empty(); }
  /// Evaluates the newest step. Returns one message for each condition first violated in it.
  std::vector<std::string> look(const Observer& observer);

  /// [{condition, meaning, unit, first_time, worst_margin}] of the violated ones.
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
