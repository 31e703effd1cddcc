// Alarms of a run of a study: the monitor, evaluated as `twin monitor` does for the log of the same
// run, message by message (monitoring/twin_monitor.h).
//
//   alarms                        number of alarms raised
//   alarms.IN_CRITICAL_BAND       number of alarms of this type (docs/alarms.md)
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "monitoring/twin_monitor.h"
#include "twin/order_observer.h"
#include "twin/step_messages.h"
#include "twin/twin.h"

namespace whirl_twin {

/// Type of the alarms counted by a measure's path, "" for all; empty if the path counts none.
std::optional<std::string> countedAlarm(const std::string& path);
/// All valid paths, for a hint.
std::vector<std::string> alarmPaths();

class AlarmWatch {
 public:
  /// The twin must outlive it. Lengthy evaluations are done synchronously.
  AlarmWatch(const Twin& twin, const AlarmSettings& settings);
  /// Takes the twin's current state: at the start, then after every step.
  void look();
  /// Number of alarms of a type, or of all.
  double raised(const std::string& type) const;

 private:
  const Twin& twin_;
  Observer observer_;
  OrderObserver orders_;
  StepMessages messages_;
  TwinMonitor monitor_;
  std::vector<double> record_;
  double ticked_ = 0.0;                // [s], simulated since the start
  std::optional<double> started_;      // [s], simulated
  std::set<std::uint32_t> ids_;        // of all raised alarms
  std::map<std::string, int> counts_;  // by type
};

}  // namespace whirl_twin
