// Publishes events of alerts on LCM and in the node's log. LCM has no latched topics and may lose
// messages: active alerts are republished every few seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "messages/alert.h"
#include "monitoring/alarm_history.h"
#include "monitoring/twin_monitor.h"
#include "transport/lcm_publisher.h"

namespace whirl_twin {

class AlertEvents {
 public:
  explicit AlertEvents(LcmPublisher& lcm) : lcm_(lcm) {}

  void tell(const state::Alert& event);
  /// Republishes the active alerts when due; now [s] is of a monotonic clock.
  void tellAgain(const std::vector<state::Alert>& active, double now);

 private:
  LcmPublisher& lcm_;
  double newest_ = 0.0;  // [s], simulated, of the published events
  double next_ = 0.0;    // [s]
};

// Saves the alarm history of the monitor in the file ~history, and publishes the events.

class KeptHistory {
 public:
  /// Reads the file, unless `path` is empty, and restores the monitor's history from it.
  KeptHistory(TwinMonitor& monitor, AlertEvents& events, const std::string& path);

  /// Saves new events and a change of the monitored run, and retries what could not be written
  /// before.
  void keep();
  void keepReset();
  void keepSettings(const std::string& text);
  /// Why the history is not saved at present; "" if it is, or without a file.
  std::string problem() const { return history_ ? history_->problem() : ""; }

 private:
  void keepEvents();
  void reportProblem();

  TwinMonitor& monitor_;
  AlertEvents& events_;
  std::optional<AlarmHistory> history_;
  std::string reported_;        ///< the problem reported last
  std::optional<TwinRun> run_;  ///< the last run in the history
};

}  // namespace whirl_twin
