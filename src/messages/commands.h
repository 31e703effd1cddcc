// A command to the inputs of a system: from the next step on they have these values, until the
// duration has elapsed and the scene's values return.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

struct InputCommand {
  static constexpr MessageKind kKind{"inputs", "InputCommand", "*/inputs", MessageKind::kCommand};
  static constexpr double kLongest = 1.0e6;  ///< [s], of a command

  Instant at;  ///< of the sender, if it has one
  std::string system;
  std::vector<std::string> input;  ///< names, as listed by `twin models`
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
      throw RejectedMessage(
          fmt::format("{}: must be > 0 s and at most 1e6 s, found {:g} s", field, duration));
    }
  }
};

// A command to the monitor about its alarms, with the arguments of its services: the system, the
// type, the duration. A field that is not given stays empty or 0.

struct AlarmCommand {
  static constexpr MessageKind kKind{"alarm_commands", "AlarmCommand", "alarm_commands",
                                     MessageKind::kCommand};
  static constexpr double kLongest = 3600.0;  ///< [s], of an inhibition, which thus ends even if
                                              ///< forgotten

  /// None is 0: a message with unset fields is rejected.
  enum Command : std::uint8_t { kAcknowledge = 1, kReset, kInhibit };

  Instant at;  ///< of the sender, if it has one
  std::uint8_t command = 0;
  std::string system;     ///< "": every one
  std::string type;       ///< of the alerts to acknowledge; "": all
  double duration = 0.0;  ///< [s], wall time, of an inhibition; 0 ends it

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head();
    visit(TWIN_FIELD(command), "", between(kAcknowledge, kInhibit));
    visit(TWIN_FIELD(system), "", requireNameOrNone);
    visit(TWIN_FIELD(type), "", requireNameOrNone);
    visit(TWIN_FIELD(duration), "s", requireDuration);
  }

 private:
  static void requireNameOrNone(const char* field, const std::string& name) {
    if (!name.empty()) {
      requireName(field, name);
    }
  }
  static void requireDuration(const char* field, double duration) {
    if (!(duration >= 0.0 && duration <= kLongest)) {
      throw RejectedMessage(
          fmt::format("{}: must be from 0 to 3600 s, found {:g} s", field, duration));
    }
  }
};

}  // namespace whirl_twin::state
