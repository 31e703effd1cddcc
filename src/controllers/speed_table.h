// Table of values over the speed of a shaft: linear interpolation, constant beyond the outer rows.
#pragma once

#include <string>
#include <vector>

#include "controllers/controller_info.h"

namespace whirl_twin {

class SpeedTable {
 public:
  SpeedTable() = default;
  /// A table of settings with a column `speed` and `columns`; empty where it is not given. Throws
  /// SetupError at a row whose speed is not greater than that of the previous one.
  SpeedTable(const Settings& settings, const std::string& name,
             const std::vector<std::string>& columns);
  /// One row: constant over the speed.
  explicit SpeedTable(std::vector<double> numbers);

  bool empty() const { return speeds_.empty(); }

  /// At the absolute value of a speed [rad/s]; not empty. Real-time safe.
  double at(double speed, std::size_t column) const noexcept;
  /// Is a column 0 at every speed?
  bool zero(std::size_t column) const;

 private:
  std::vector<double> speeds_;
  std::size_t columns_ = 0;
  std::vector<double> numbers_;  // row by row
};

/// The description of a table over speed as a setting.
SettingInfo speedTableSetting(const std::string& name, const std::string& meaning,
                              std::vector<ColumnInfo> columns);

}  // namespace whirl_twin
