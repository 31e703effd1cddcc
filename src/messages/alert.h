// One alert of the monitor; fields as in whirl_twin/Alert.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace whirl_twin::state {

enum class Severity : std::uint8_t { kInfo = 0, kWarning = 1, kDanger = 2 };

struct Alert {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::uint32_t id = 0;  ///< counts up; kept from raised to cleared
  std::string type;      ///< CRITICAL_SPEED_APPROACH, IN_CRITICAL_BAND, UNSTABLE, ...
  std::string system;
  Severity severity = Severity::kInfo;
  bool raised = true;                         ///< in the active list
  double raised_time = 0.0;                   ///< [s], simulated
  double time = 0.0;                          ///< [s], simulated
  std::int64_t stamp = 0;                     ///< [ns], of the state it was last judged on
  double speed = kNone;                       ///< [rad/s]
  double acceleration = kNone;                ///< [rad/s^2]
  double critical_speed = kNone;              ///< [rad/s]
  double time_to_entry = kNone;               ///< [s]
  double separation_margin = kNone;           ///< [percent]
  double required_separation_margin = kNone;  ///< [percent]
  double amplification_factor = kNone;        ///< [-]
  double decay_rate = kNone;                  ///< [1/s]
  std::string text;                           ///< one sentence for a person
};

}  // namespace whirl_twin::state
