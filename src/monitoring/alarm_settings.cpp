#include "monitoring/alarm_settings.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl_twin {

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
  positive("energy_residual", settings.energy_residual, "> 0 (dimensionless)");
  positive("data_timeout", settings.data_timeout, "> 0 s");
  return errors;
}

}  // namespace whirl_twin
