// What happens to alerts, on LCM and in the node's log. LCM latches nothing and loses what it
// likes: the alerts that stand are told again every few seconds.
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
  /// Those that stand, where it is time for it; now [s] is of a clock that nobody sets.
  void tellAgain(const std::vector<state::Alert>& active, double now);

 private:
  LcmPublisher& lcm_;
  double newest_ = 0.0;  // [s], simulated, of the events told
  double next_ = 0.0;    // [s]
};

// The history of the alarms that the monitor keeps in the file ~history, and what is told of
// events.

class KeptHistory {
 public:
  /// Reads the file, unless `path` is empty, and gives its history to the monitor.
  KeptHistory(TwinMonitor& monitor, AlertEvents& events, const std::string& path);

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
