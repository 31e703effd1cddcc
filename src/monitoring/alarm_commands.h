// What people tell the monitor about its alarms, whichever way it comes: acknowledge, reset,
// inhibit. A command that cannot be meant is refused whole, with a sentence.
#pragma once

#include <string>

#include "messages/commands.h"
#include "monitoring/twin_monitor.h"

namespace whirl_twin {

struct CommandAnswer {
  bool done = false;
  std::string text;  ///< what was done, or why it was not
};

/// wall_time [s]: now, of the clock the monitor is told; by: who commands, as people find them.
CommandAnswer carryOut(const state::AlarmCommand& command, TwinMonitor& monitor, double wall_time,
                       const std::string& by = "an unknown sender");

}  // namespace whirl_twin
