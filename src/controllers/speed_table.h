// Numbers over the speed of a shaft: straight lines from row to row, the outer rows beyond them.
#pragma once

#include <string>
#include <vector>

#include "controllers/controller_info.h"

namespace whirl_twin {

class SpeedTable {
 public:
  SpeedTable() = default;
  /// A table of settings with a column `speed` and `columns`; empty where it is not given. Throws
  /// SetupError at the row whose speed is not greater than that before.
  SpeedTable(const Settings& settings, const std::string& name,
             const std::vector<std::string>& columns);
  /// One row: these numbers at any speed.
  explicit SpeedTable(std::vector<double> numbers);

  bool empty() const { return speeds_.empty(); }

  /// By the size of a speed [rad/s]; not empty. Real-time safe.
  double at(double speed, std::size_t column) const noexcept;
  /// Is a column 0 at every speed?
  bool zero(std::size_t column) const;

 private:
  std::vector<double> speeds_;
  std::size_t columns_ = 0;
  std::vector<double> numbers_;  // row by row
};

/// What a table over speed says of itself.
SettingInfo speedTableSetting(const std::string& name, const std::string& meaning,
                              std::vector<ColumnInfo> columns);

}  // namespace whirl_twin
