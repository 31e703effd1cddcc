// Alerts of a monitor that was there before, until it is known whether their causes are there
// still: an alarm that finds its cause raises its alert again, which keeps its id. Those that no
// alarm has raised when what they are about has been heard again for long enough to raise all that
// there is to raise are cleared; and all are where the simulation has been started anew or reset
// meanwhile, which it has to say twice.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "messages/loop_statistics.h"
#include "monitoring/alarm_memory.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"

namespace whirl_twin {

class RestoredAlerts {
 public:
  explicit RestoredAlerts(const AlarmSettings& settings);

  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  /// The list is to know what was known.
  void begin(const AlarmMemory& memory, AlertList& alerts);
  /// A state of a source came, at time [s, simulated].
  void heard(const std::string& source, double time, AlertList& alerts);
  /// What comes from a source cannot be judged: the time that it is heard begins anew.
  void interrupted(const std::string& source) { heard_since_.erase(source); }
  /// The simulation said how its systems fare.
  void heard(const state::LoopStatistics& loop, AlertList& alerts);
  /// Time has begun anew.
  void restart() { heard_since_.clear(); }

 private:
  /// [s], simulated, without a break.
  double heardFor(const std::string& source, double time);
  /// [s], simulated, after which a cause that is there would have been seen.
  double patienceOf(const std::string& type) const;

  double patience_ = 0.0;         ///< [s], without what follows
  double saturation_time_ = 0.0;  ///< [s]
  std::optional<TwinRun> run_;
  std::optional<TwinRun> other_run_;  ///< as said once
  std::map<std::string, double> heard_since_;
  bool any_ = false;
};

}  // namespace whirl_twin
