// A command to the inputs of a system, for the twin to take: from the next step on they have these
// values, until the duration is out and the scene's own return.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "messages/states.h"

namespace whirl_twin::state {

struct InputCommand {
  static constexpr MessageKind kKind{"inputs", "InputCommand", "*/inputs", MessageKind::kCommand};
  static constexpr double kLongest = 1.0e6;  ///< [s], of a command

  Instant at;  ///< of the sender, if it has one
  std::string system;
  std::vector<std::string> input;  ///< names, as `twin models` has them
  std::vector<double> value;       ///< of each, in the input's unit; finite
  double duration = 0.0;           ///< [s], simulated; > 0

  template <class Visit>
  static void fields(Visit& visit) {
    const auto input = TWIN_FIELD(input);
    visit.head(TWIN_FIELD(system));
    visit.array(TWIN_FIELD(inputs), input, "", each(requireName));
    visit.along(input, TWIN_FIELD(value), "", each(requireFinite));
    visit(TWIN_FIELD(duration), "s", requireDuration);
  }

 private:
  static void requireFinite(const char* field, double value) {
    if (!std::isfinite(value)) {
      throw RejectedMessage(std::string(field) + ": must be finite numbers");
    }
  }
  static void requireDuration(const char* field, double duration) {
    if (!(duration > 0.0 && duration <= kLongest)) {
      throw RejectedMessage(std::string(field) + ": must be > 0 s and at most 1e6 s");
    }
  }
};

}  // namespace whirl_twin::state
