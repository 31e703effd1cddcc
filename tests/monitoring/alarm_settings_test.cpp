// The settings of the monitor: the file holds the defaults, and nonsense is named.
#include "monitoring/alarm_settings.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <limits>
#include <string>

namespace whirl_twin {
namespace alarm_settings_test {

TEST(AlarmSettings, TheFileHoldsTheDefaults) {
  const YAML::Node file = YAML::LoadFile(std::string(WHIRL_TWIN_SOURCE) + "/config/monitor.yaml");
  const AlarmSettings defaults;
  EXPECT_EQ(file["approach_time"].as<double>(), defaults.approach_time);
  EXPECT_EQ(file["clear_delay"].as<double>(), defaults.clear_delay);
  EXPECT_EQ(file["hysteresis"].as<double>(), defaults.hysteresis);
  EXPECT_EQ(file["dwell_limit"].as<double>(), defaults.dwell_limit);
  EXPECT_EQ(file["decay_rate_alarm"].as<double>(), defaults.decay_rate_alarm);
  EXPECT_EQ(file["log_decrement_warning"].as<double>(), defaults.log_decrement_warning);
  EXPECT_EQ(file["sensitivity_warning"].as<double>(), defaults.sensitivity_warning);
  EXPECT_EQ(file["saturation_time"].as<double>(), defaults.saturation_time);
  EXPECT_EQ(file["members_beyond"].as<double>(), defaults.members_beyond);
  EXPECT_EQ(file["lowest_decay_rate"].as<double>(), defaults.lowest_decay_rate);
  EXPECT_EQ(file["energy_residual"].as<double>(), defaults.energy_residual);
  EXPECT_EQ(file["data_timeout"].as<double>(), defaults.data_timeout);
}

TEST(AlarmSettings, TheDefaultsCanBeUsed) {
  EXPECT_TRUE(settingErrors(AlarmSettings()).empty());
}

TEST(AlarmSettings, EveryValueOutOfRangeIsNamedWithItsUnitAndWhatWasFound) {
  AlarmSettings settings;
  settings.approach_time = -1.0;
  settings.clear_delay = -0.5;
  settings.hysteresis = 1.0;
  settings.dwell_limit = 0.0;
  settings.decay_rate_alarm = -2.0;
  settings.log_decrement_warning = std::numeric_limits<double>::quiet_NaN();
  settings.energy_residual = 0.0;
  settings.data_timeout = std::numeric_limits<double>::infinity();
  const std::vector<std::string> errors = settingErrors(settings);
  ASSERT_EQ(errors.size(), 8u);
  EXPECT_EQ(errors[0], "approach_time: must be > 0 s, found -1");
  EXPECT_EQ(errors[1], "clear_delay: must be >= 0 s, found -0.5");
  EXPECT_EQ(errors[2], "hysteresis: must be >= 0 and < 1 (a fraction), found 1");
  EXPECT_EQ(errors[3], "dwell_limit: must be > 0 s, found 0");
  EXPECT_EQ(errors[4], "decay_rate_alarm: must be >= 0 1/s, found -2");
  EXPECT_EQ(errors[5], "log_decrement_warning: must be >= 0 (dimensionless), found nan");
  EXPECT_EQ(errors[6], "energy_residual: must be > 0 (dimensionless), found 0");
  EXPECT_EQ(errors[7], "data_timeout: must be > 0 s, found inf");
}

}  // namespace alarm_settings_test
}  // namespace whirl_twin
