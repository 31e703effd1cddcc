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

const std::vector<AlarmSetting>& alarmSettings() {
  using S = AlarmSettings;
  const auto any = [](double) { return true; };
  const auto positive = [](double x) { return x > 0.0; };
  const auto not_negative = [](double x) { return x >= 0.0; };
  const auto fraction = [](double x) { return x >= 0.0 && x <= 1.0; };
  static const std::vector<AlarmSetting> all{
      {"approach_time", &S::approach_time, positive, "> 0 s"},
      {"clear_delay", &S::clear_delay, not_negative, ">= 0 s"},
      {"hysteresis", &S::hysteresis, [](double x) { return x >= 0.0 && x < 1.0; },
       ">= 0 and < 1 (a fraction)"},
      {"dwell_limit", &S::dwell_limit, positive, "> 0 s"},
      {"decay_rate_alarm", &S::decay_rate_alarm, not_negative, ">= 0 1/s"},
      {"log_decrement_warning", &S::log_decrement_warning, not_negative, ">= 0 (dimensionless)"},
      {"sensitivity_warning", &S::sensitivity_warning, [](double x) { return x == 0.0 || x > 1.0; },
       "0, or > 1 (dimensionless)"},
      {"saturation_time", &S::saturation_time, [](double x) { return x == 0.0 || x >= 1.0; },
       "0, or >= 1 s"},
      {"members_beyond", &S::members_beyond, fraction, "from 0 to 1 (a fraction)"},
      {"lowest_decay_rate", &S::lowest_decay_rate, any, "a number in 1/s"},
      {"energy_residual", &S::energy_residual, positive, "> 0 (dimensionless)"},
      {"data_timeout", &S::data_timeout, positive, "> 0 s"},
      {"decay_audit", &S::decay_audit,
       [](double x) { return x == 0.0 || (x >= 5.0 && x <= 3600.0); }, "0, or from 5 to 3600 s"},
      {"sensor_delay", &S::sensor_delay, not_negative, ">= 0 s"},
      {"clock_offset", &S::clock_offset, not_negative, ">= 0 s"},
      {"clock_drift", &S::clock_drift, not_negative, ">= 0 (dimensionless)"},
      {"trip_multiply", &S::trip_multiply, [](double x) { return x >= 1.0 && x <= 10.0; },
       "from 1 to 10 (dimensionless)"},
      {"start_up_acceleration", &S::start_up_acceleration, not_negative, ">= 0 rad/s^2"},
      {"max_inhibition", &S::max_inhibition, [](double x) { return x > 0.0 && x <= 3600.0; },
       "> 0 and <= 3600 s"}};
  return all;
}

std::vector<std::string> settingErrors(const AlarmSettings& settings) {
  std::vector<std::string> errors;
  for (const AlarmSetting& setting : alarmSettings()) {
    const double value = settings.*setting.value;
    if (!std::isfinite(value) || !setting.isInRange(value)) {
      errors.push_back(
          fmt::format("{}: must be {}, found {:g}", setting.key, setting.expected, value));
    }
  }
  return errors;
}

}  // namespace whirl_twin
