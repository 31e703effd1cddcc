// Warns when the equations of a system stop describing its machine, once for each condition.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/validity.h"
#include "reports/output.h"
#include "twin/observer.h"

namespace whirl_twin {

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
