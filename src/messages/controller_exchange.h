// What goes to a controller in another process, and what it answers.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

struct ControllerMeasurement {
  static constexpr MessageKind kKind{"sample", "ControllerMeasurement", "controllers/*/measurement",
                                     MessageKind::kSeries};

  Instant at;  ///< step: the index of the sample
  std::string controller;
  std::vector<double> values;  ///< of what it measures
  std::int64_t run = 0;        ///< of simulated time: another after each reset

  template <class Visit>
  static void fields(Visit& visit) {
    visit.sampled(TWIN_FIELD(controller));
    visit.array(TWIN_FIELD(count), TWIN_FIELD(values), "");
    visit(TWIN_FIELD(run), "", between(0, std::numeric_limits<std::int64_t>::max()));
  }
};

struct ControllerCommand {
  static constexpr MessageKind kKind{"command", "ControllerCommand", "controllers/*/command",
                                     MessageKind::kCommand};

  Instant at;  ///< of the sample that it answers
  std::string controller;
  std::vector<double> values;  ///< of what it acts on
  std::int64_t run = 0;        ///< of the sample; 0: not told

  template <class Visit>
  static void fields(Visit& visit) {
    visit.sampled(TWIN_FIELD(controller));
    visit.array(TWIN_FIELD(count), TWIN_FIELD(values), "");
    visit(TWIN_FIELD(run), "", between(0, std::numeric_limits<std::int64_t>::max()));
  }
};

}  // namespace whirl_twin::state
