#include "display/terminal_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "display/status_text.h"
#include "messages/names.h"

namespace whirl_twin {
namespace {

const Alert* findAlert(const std::vector<Alert>& alerts, const Alert& wanted) {
  // The number alone is ambiguous: a restarted monitor counts from one again.
  const auto found = std::find_if(alerts.begin(), alerts.end(), [&](const Alert& alert) {
    return alert.id == wanted.id && alert.type == wanted.type && alert.system == wanted.system &&
           alert.raised_time == wanted.raised_time;
  });
  return found == alerts.end() ? nullptr : &*found;
}

}  // namespace

std::string readoutText(const std::string& system, const SystemReadout& readout) {
  std::vector<std::string> parts;
  if (readout.whirl) {
    parts.push_back(speedText(readout.whirl->speed));
    if (const std::string vibration = vibrationText(readout.vibration); !vibration.empty()) {
      parts.push_back(vibration);
    }
  }
  if (readout.orders) {
    parts.push_back(ordersText(*readout.orders));
  }
  if (readout.pendulum) {
    parts.push_back(
        coordinateText(coordinatesByName(readout.pendulum->name), readout.pendulum->angle));
  }
  if (readout.margin) {
    const int nearest = nearestCriticalSpeed(*readout.margin);
    for (const auto& part :
         {verdictText(*readout.margin), decayText(*readout.margin),
          criticalSpeedText(*readout.margin, nearest), separationText(*readout.margin, nearest)}) {
      if (!part.empty()) {
        parts.push_back(part);
      }
    }
  }
  return fmt::format("{}: {}", system, fmt::join(parts, ", "));
}

std::vector<std::string> alertChanges(const std::vector<Alert>& before,
                                      const std::vector<Alert>& now, double time) {
  std::vector<std::string> lines;
  for (const auto& alert : now) {
    const Alert* known = findAlert(before, alert);
    if (known == nullptr || known->severity != alert.severity) {
      lines.push_back(fmt::format("[{:.3f} s] {} {}: {}", alert.time, severityName(alert.severity),
                                  known == nullptr ? "raised" : "now", alert.text));
    } else if (known->acknowledged == 0 && alert.acknowledged != 0) {
      lines.push_back(fmt::format("[{:.3f} s] {} acknowledged: {} {}", time,
                                  severityName(alert.severity), alert.system, alert.type));
    }
  }
  for (const auto& alert : before) {
    if (findAlert(now, alert) == nullptr) {
      lines.push_back(fmt::format("[{:.3f} s] {} cleared: {} {}", time,
                                  severityName(alert.severity), alert.system, alert.type));
    }
  }
  return lines;
}

std::string heldBackText(const MonitorStatus& monitor) {
  const auto held = std::count_if(monitor.inhibited.begin(), monitor.inhibited.end(),
                                  [](double left) { return left > 0.0; });
  return held == 0
             ? ""
             : fmt::format("ALERTS OF {} SYSTEM{} INHIBITED for another {:.0f} s", held,
                           held == 1 ? "" : "S",
                           *std::max_element(monitor.inhibited.begin(), monitor.inhibited.end()));
}

std::string fitted(const std::string& line, std::size_t columns) {
  const std::string shown = printable(line, line.size());
  if (shown.size() <= columns) {
    return shown;
  }
  return columns < 3 ? shown.substr(0, columns) : printable(shown, columns - 3);
}

}  // namespace whirl_twin
