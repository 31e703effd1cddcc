// The history of the alarms that the monitor keeps in the file ~history, and what is told of
// events.
#pragma once

#include <optional>
#include <string>

#include "monitoring/alarm_history.h"
#include "monitoring/twin_monitor.h"
#include "nodes/alert_events.h"

namespace whirl_twin {

class KeptHistory {
 public:
  /// Reads what ~history has, if it names a file, and gives it to the monitor.
  KeptHistory(TwinMonitor& monitor, AlertEvents& events);

  /// What has happened to alerts since, which run is watched, and what could not be written before.
  void keep();
  void keepReset();
  void keepSettings(const std::string& text);
  /// Why nothing is kept at present; "" as long as it is, or where no file is asked for.
  std::string problem() const { return history_ ? history_->problem() : ""; }

 private:
  void keepEvents();
  void reportProblem();

  TwinMonitor& monitor_;
  AlertEvents& events_;
  std::optional<AlarmHistory> history_;
  std::string reported_;        ///< the problem, as it was reported last
  std::optional<TwinRun> run_;  ///< as the history knows it
};

}  // namespace whirl_twin
