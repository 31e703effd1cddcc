// The monitor beside a run of a study, and what it raised: as `twin monitor` judges the log of the
// same run, message by message (monitoring/twin_monitor.h).
//
//   alarms                        how often any alarm was raised
//   alarms.IN_CRITICAL_BAND       how often one of that type was (docs/alarms.md)
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

/// The type of alarm that a measure's path counts, "" for any; nothing where it counts none.
std::optional<std::string> countedAlarm(const std::string& path);
/// How they are written, for a hint.
std::vector<std::string> alarmPaths();

class AlarmWatch {
 public:
  /// The twin outlives it. Judges at once, what takes long too.
  AlarmWatch(const Twin& twin, const AlarmSettings& settings);
  /// Takes the twin's present state: that of the start, then of every step.
  void look();
  /// Of a type, or of any.
  double raised(const std::string& type) const;

 private:
  const Twin& twin_;
  Observer observer_;
  OrderObserver orders_;
  StepMessages messages_;
  TwinMonitor monitor_;
  std::vector<double> record_;
  double ticked_ = 0.0;                // s, simulated since the start
  std::optional<double> started_;      // s, simulated
  std::set<std::uint32_t> ids_;        // of all that were raised
  std::map<std::string, int> counts_;  // of each type
};

}  // namespace whirl_twin
