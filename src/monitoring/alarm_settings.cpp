#include "monitoring/alarm_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace whirl_twin {

double AmplitudeLevels::levelAt(const std::vector<double>& levels, double shaft_speed) const {
  if (levels.empty()) {
    return std::numeric_limits<double>::infinity();
  }
  const double s = std::abs(shaft_speed);
  const auto above =
      static_cast<std::size_t>(std::upper_bound(speed.begin(), speed.end(), s) - speed.begin());
  if (above == 0) {
    return levels.front();
  }
  if (above == speed.size()) {
    return levels.back();
  }
  const double part = (s - speed[above - 1]) / (speed[above] - speed[above - 1]);
  return levels[above - 1] + part * (levels[above] - levels[above - 1]);
}

AlarmDelays AlarmSettings::delaysOf(const std::string& type) const {
  const auto own = delays.find(type);
  return own == delays.end() ? AlarmDelays{0.0, clear_delay} : own->second;
}

std::vector<std::string> settingErrors(const AlarmSettings& settings) {
  std::vector<std::string> errors;
  const auto check = [&errors](const char* key, double value, bool in_range, const char* expected) {
    if (!in_range || !std::isfinite(value)) {
      errors.push_back(fmt::format("{}: must be {}, found {:g}", key, expected, value));
    }
  };
  const auto positive = [&check](const char* key, double value, const char* expected) {
    check(key, value, value > 0.0, expected);
  };
  const auto not_negative = [&check](const char* key, double value, const char* expected) {
    check(key, value, value >= 0.0, expected);
  };
  positive("approach_time", settings.approach_time, "> 0 s");
  not_negative("clear_delay", settings.clear_delay, ">= 0 s");
  check("hysteresis", settings.hysteresis, settings.hysteresis >= 0.0 && settings.hysteresis < 1.0,
        ">= 0 and < 1 (a fraction)");
  positive("dwell_limit", settings.dwell_limit, "> 0 s");
  not_negative("decay_rate_alarm", settings.decay_rate_alarm, ">= 0 1/s");
  not_negative("log_decrement_warning", settings.log_decrement_warning, ">= 0 (dimensionless)");
  check("sensitivity_warning", settings.sensitivity_warning,
        settings.sensitivity_warning == 0.0 || settings.sensitivity_warning > 1.0,
        "0, or > 1 (dimensionless)");
  check("saturation_time", settings.saturation_time,
        settings.saturation_time == 0.0 || settings.saturation_time >= 1.0, "0, or >= 1 s");
  check("members_beyond", settings.members_beyond,
        settings.members_beyond >= 0.0 && settings.members_beyond <= 1.0,
        "from 0 to 1 (a fraction)");
  check("lowest_decay_rate", settings.lowest_decay_rate, std::isfinite(settings.lowest_decay_rate),
        "a number in 1/s");
  positive("energy_residual", settings.energy_residual, "> 0 (dimensionless)");
  positive("data_timeout", settings.data_timeout, "> 0 s");
  check("decay_audit", settings.decay_audit,
        settings.decay_audit == 0.0 ||
            (settings.decay_audit >= 5.0 && settings.decay_audit <= 3600.0),
        "0, or from 5 to 3600 s");
  not_negative("sensor_delay", settings.sensor_delay, ">= 0 s");
  not_negative("clock_offset", settings.clock_offset, ">= 0 s");
  not_negative("clock_drift", settings.clock_drift, ">= 0 (dimensionless)");
  check("trip_multiply", settings.trip_multiply,
        settings.trip_multiply >= 1.0 && settings.trip_multiply <= 10.0,
        "from 1 to 10 (dimensionless)");
  not_negative("start_up_acceleration", settings.start_up_acceleration, ">= 0 rad/s^2");
  check("max_inhibition", settings.max_inhibition,
        settings.max_inhibition > 0.0 && settings.max_inhibition <= 3600.0, "> 0 and <= 3600 s");
  return errors;
}

}  // namespace whirl_twin
