// Commands to the alarms, whichever way they come: acknowledge, reset, inhibit. An invalid command
// is rejected as a whole, with a sentence.
#pragma once

#include <string>

#include "messages/commands.h"
#include "monitoring/twin_monitor.h"

namespace whirl_twin {

struct CommandAnswer {
  bool done = false;
  std::string text;  ///< what was done, or why it was not
};

/// wall_time [s]: now, by the clock of TwinMonitor::tick(); by: the sender.
CommandAnswer carryOut(const state::AlarmCommand& command, TwinMonitor& monitor, double wall_time,
                       const std::string& by = "an unknown sender");

}  // namespace whirl_twin
