// Whether what comes from a system can be judged at all: not-OK, as machine protection has it,
// which is no alarm, raises none and clears none. Stale: no state for data_timeout, while the
// simulation is not held. Not finite: a number of its newest state is none. Out of range: its whirl
// is wider than what the settings call its range. Stuck: x or y of its whirl was in motion, and is
// the same to the last digit since (stuck_channel.h).
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "messages/states.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/stuck_channel.h"

namespace whirl_twin {

class DataQuality {
 public:
  DataQuality(std::string system, const AlarmSettings& settings);
  /// timeout [s, wall], range [m].
  DataQuality(double timeout, double range) : timeout_(timeout), range_(range) {}

  /// Other settings from now on; they judge the next state.
  void set(const AlarmSettings& settings);
  void set(double timeout, double range) {
    timeout_ = timeout;
    range_ = range;
  }
  /// A state came at wall_time [s]; returns whether it can be judged.
  bool take(const state::WhirlState& whirl, double wall_time);
  bool take(const state::PendulumState& pendulum, double wall_time);
  /// Time begins anew: what was seen before says nothing of what comes.
  void restart() { sampled_at_ = std::numeric_limits<double>::quiet_NaN(); }
  /// Some state has come.
  bool heard() const { return !std::isinf(heard_at_); }
  /// No state has come for too long, or none ever.
  bool isStale(double wall_time) const;
  /// Why what comes cannot be judged; "": it can. paused: the simulation says that it is held.
  std::string notOk(double wall_time, bool paused) const;

 private:
  bool take(std::string unfit, double wall_time);
  std::string stuck(const state::WhirlState& whirl);

  std::string system_;
  double timeout_ = 0.0;                                        ///< [s, wall]
  double range_ = std::numeric_limits<double>::infinity();      ///< [m]
  double heard_at_ = -std::numeric_limits<double>::infinity();  ///< [s, wall]
  std::string unfit_;                                           ///< why the newest state is
  StuckChannel x_, y_;
  double sampled_at_ = std::numeric_limits<double>::quiet_NaN();  ///< [s], simulated
  double period_ = 0.0;                                           ///< [s], between samples
};

}  // namespace whirl_twin
