// Whether the monitor is still there, for those who show what it said: it beats once a second of
// wall time. One that was never heard is not missed, for a twin may run without.
#pragma once

#include <cmath>
#include <optional>
#include <string>

namespace whirl_twin {

class MonitorPulse {
 public:
  void beat(double wall_time) { heard_at_ = wall_time; }

  /// At wall_time [s]: "no message from the monitor for 5 s: nothing is monitored"; "" while it
  /// beats.
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
