#include "monitoring/alarm_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "messages/alert.h"
#include "messages/names.h"
#include "messages/wall_clock.h"

namespace whirl_twin {

namespace {

using state::AlarmCommand;

CommandAnswer rejected(std::string why) {
  return {false, std::move(why)};
}

bool isIn(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string systemText(const std::string& system) {
  return system.empty() ? "every system" : system;
}

/// "", or that a system or type is none.
std::string targetError(const AlarmCommand& command, const TwinMonitor& monitor) {
  std::vector<std::string> systems = monitor.systemNames();
  if (command.command == AlarmCommand::kAcknowledge) {
    systems.emplace_back(alert_type::kEverybody);  // alerts can be about all of the twin
  }
  if (!command.system.empty() && !isIn(systems, command.system)) {
    return fmt::format("system: must be a system of the scene, found {}{}",
                       inQuotes(command.system), hint(command.system, monitor.systemNames()));
  }
  const std::vector<std::string> types(std::begin(alert_type::kAll), std::end(alert_type::kAll));
  if (!command.type.empty() && !isIn(types, command.type)) {
    return fmt::format("type: must be a type of alert, found {}{}", inQuotes(command.type),
                       hint(command.type, types));
  }
  return "";
}

std::string sinceNow(const std::string& by) {
  return fmt::format("{} since {}", by, isoTime(wallClock()));
}

CommandAnswer acknowledge(const AlarmCommand& command, AlertList& alerts, const std::string& by) {
  const std::vector<state::Alert> active = alerts.active();
  const bool all = command.system.empty() && command.type.empty();
  const bool any = std::any_of(active.begin(), active.end(), [&](const state::Alert& alert) {
    return (command.system.empty() || command.system == alert.system) &&
           (command.type.empty() || command.type == alert.type);
  });
  if (!any && !all) {
    return rejected(
        fmt::format("no active alert {} of {}", command.type, systemText(command.system)));
  }
  return {true, fmt::format("{} acknowledged",
                            alerts.acknowledge(command.system, command.type, sinceNow(by)))};
}

CommandAnswer reset(TwinMonitor& monitor, const std::string& by) {
  AlertList& alerts = monitor.alerts();
  const std::size_t cleared = alerts.reset(monitor.time(), sinceNow(by));
  return {true, fmt::format("{} cleared, {} still active because their cause persists", cleared,
                            alerts.active().size())};
}

CommandAnswer inhibit(const AlarmCommand& command, TwinMonitor& monitor, double wall_time,
                      const std::string& by) {
  if (!(command.duration >= 0.0 && command.duration <= AlarmCommand::kLongest)) {
    return rejected(fmt::format("duration: must be from 0 to {:g} s, found {:g}",
                                AlarmCommand::kLongest, command.duration));
  }
  const double lasts = monitor.inhibit(command.system, command.duration, wall_time, by).value();
  if (!(lasts > 0.0)) {
    return {true, fmt::format("alerts of {} are no longer inhibited", systemText(command.system))};
  }
  const std::string most = lasts < command.duration
                               ? fmt::format(" (max_inhibition), not {:g} s", command.duration)
                               : "";
  return {true, fmt::format("alerts of {} are inhibited for {:g} s{}", systemText(command.system),
                            lasts, most)};
}

}  // namespace

CommandAnswer carryOut(const AlarmCommand& command, TwinMonitor& monitor, double wall_time,
                       const std::string& by) {
  const std::string wrong = targetError(command, monitor);
  if (!wrong.empty()) {
    return rejected(wrong);
  }
  // A field that a command does not use is a sign of a different one.
  if (command.command != AlarmCommand::kInhibit && command.duration != 0.0) {
    return rejected(fmt::format("duration: must be 0 except for command 3 (inhibit), found {:g}",
                                command.duration));
  }
  if (command.command != AlarmCommand::kAcknowledge && !command.type.empty()) {
    return rejected(fmt::format("type: must be empty except for command 1 (acknowledge), found {}",
                                command.type));
  }
  switch (command.command) {
    case AlarmCommand::kAcknowledge:
      return acknowledge(command, monitor.alerts(), by);
    case AlarmCommand::kReset:
      return command.system.empty()
                 ? reset(monitor, by)
                 : rejected(fmt::format(
                       "system: must be empty, since command 2 resets all alarms, found {}",
                       command.system));
    case AlarmCommand::kInhibit:
      return inhibit(command, monitor, wall_time, by);
    default:
      return rejected(fmt::format("command: must be 1, 2 or 3, found {}", command.command));
  }
}

}  // namespace whirl_twin
