// The monitor's heartbeat, with the age of its verdicts and its processor load.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "messages/states.h"

namespace whirl_twin {

// Heartbeat supervision of the monitor, for displays of its results: one heartbeat per second of
// wall time. No timeout is reported before the first heartbeat: a twin may run without a monitor.

class MonitorPulse {
 public:
  void beat(double wall_time) { heard_at_ = wall_time; }

  /// At wall_time [s]: "no message from the monitor for 5 s: nothing is monitored"; "" without a
  /// timeout.
  std::string silence(double wall_time) const {
    if (!heard_at_ || std::fabs(wall_time - *heard_at_) <= kPatience) {
      return "";
    }
    return "no message from the monitor for " +
           std::to_string(std::lround(std::fabs(wall_time - *heard_at_))) +
           " s: nothing is monitored";
  }

 private:
  static constexpr double kPatience = 3.0;  // s

  std::optional<double> heard_at_;  ///< [s]
};

}  // namespace whirl_twin

namespace whirl_twin::state {

struct MonitorStatus {
  static constexpr MessageKind kKind{"monitor", "MonitorStatus", "monitor", MessageKind::kJudged};

  Instant at;                ///< of the newest state received; stamp: of this message
  bool paused = false;       ///< the simulation reports that it is paused
  double load = 0.0;         ///< [-], fraction of one core used by evaluations in the last second
  std::int64_t alerts = 0;   ///< active
  std::int64_t dangers = 0;  ///< of them, of severity DANGER
  // One entry a system.
  std::vector<std::string> system;
  std::vector<double> verdict_age;  ///< [s], wall time since the arrival of the state evaluated;
                                    ///< NaN: none yet
  std::vector<std::string> not_ok;  ///< why data from it cannot be evaluated; "": they can
  std::vector<double> inhibited;    ///< [s], wall time for which its alerts remain inhibited; else
                                    ///< 0

  template <class Visit>
  static void fields(Visit& visit) {
    const auto count = between(0, std::numeric_limits<std::int64_t>::max());
    visit.head();
    visit(TWIN_FIELD(paused), "", requireFlag);
    visit(TWIN_FIELD(load), "-");
    visit(TWIN_FIELD(alerts), "", count);
    visit(TWIN_FIELD(dangers), "", count);
    visit.array(TWIN_FIELD(systems), TWIN_FIELD(system), "", each(requireName), Stays::kSame);
    visit.along(TWIN_FIELD(system), TWIN_FIELD(verdict_age), "s");
    visit.along(TWIN_FIELD(system), TWIN_FIELD(not_ok), "", each(requireText));
    visit.along(TWIN_FIELD(system), TWIN_FIELD(inhibited), "s");
  }
};

}  // namespace whirl_twin::state
