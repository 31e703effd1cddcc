// A command to the monitor about its alarms: the same as its services take. It is told which
// system, which type, how long; what it does not speak of stays empty or 0.
#pragma once

#include <cstdint>
#include <string>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

struct AlarmCommand {
  static constexpr MessageKind kKind{"alarm_commands", "AlarmCommand", "alarm_commands",
                                     MessageKind::kCommand};
  static constexpr double kLongest = 3600.0;  ///< [s], of an inhibition: one forgotten ends

  /// None is 0: a message that nobody has filled in is refused.
  enum Command : std::uint8_t { kAcknowledge = 1, kReset, kInhibit };

  Instant at;  ///< of the sender, if it has one
  std::uint8_t command = 0;
  std::string system;     ///< "": every one
  std::string type;       ///< of the alerts that are acknowledged; "": every one
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
      throw RejectedMessage(std::string(field) + ": must be from 0 to 3600 s");
    }
  }
};

}  // namespace whirl_twin::state
