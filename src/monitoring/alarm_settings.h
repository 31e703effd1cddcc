// What a protection engineer sets: when to warn, when to call it danger, when to let go.
// The defaults are those of config/monitor.yaml.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

struct AlarmSettings {
  double approach_time = 2.0;          ///< [s], warn when a critical band will be entered within
  double clear_delay = 1.0;            ///< [s], an alert clears after this long without its cause
  double hysteresis = 0.02;            ///< [-], part of a limit to go back beyond before clearing
  double dwell_limit = 3.0;            ///< [s], in a critical band before it is danger
  double decay_rate_alarm = 0.0;       ///< [1/s], warn when decay is slower; 0: do not
  double log_decrement_warning = 0.1;  ///< [-], warn below (API 617 stability); 0: do not
  double energy_residual = 1.0e-6;     ///< [-], warn when the energy balance is off by more
  double data_timeout = 1.0;           ///< [s] wall time, silence of one system among others
};

/// What is wrong with the settings, one sentence a value ("clear_delay: must be >= 0 s, found -1");
/// empty when they can be used.
std::vector<std::string> settingErrors(const AlarmSettings& settings);

}  // namespace whirl_twin
