#include "controllers/speed_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl_twin {

SpeedTable::SpeedTable(const Settings& settings, const std::string& name,
                       const std::vector<std::string>& columns)
    : columns_(columns.size()) {
  const auto found = settings.tables.find(name);
  if (found == settings.tables.end()) {
    return;
  }
  for (const TableRow& row : found->second) {
    const double speed = row.numbers.at("speed");
    if (!speeds_.empty() && !(speed > speeds_.back())) {
      throw SetupError(
          fmt::format("{}[{}].speed", name, speeds_.size()),
          fmt::format("must be > {} rad/s, the row before, found {}", speeds_.back(), speed));
    }
    speeds_.push_back(speed);
    for (const std::string& column : columns) {
      numbers_.push_back(row.numbers.at(column));
    }
  }
}

SpeedTable::SpeedTable(std::vector<double> numbers)
    : speeds_{0.0}, columns_(numbers.size()), numbers_(std::move(numbers)) {}

double SpeedTable::at(double speed, std::size_t column) const noexcept {
  const double size = std::abs(speed);
  const auto above = static_cast<std::size_t>(
      std::upper_bound(speeds_.begin(), speeds_.end(), size) - speeds_.begin());
  if (above == 0) {
    return numbers_[column];
  }
  const double* low = &numbers_[(above - 1) * columns_];
  if (above == speeds_.size()) {
    return low[column];
  }
  const double part = (size - speeds_[above - 1]) / (speeds_[above] - speeds_[above - 1]);
  return low[column] + part * (low[columns_ + column] - low[column]);
}

bool SpeedTable::zero(std::size_t column) const {
  for (std::size_t i = column; i < numbers_.size(); i += columns_) {
    if (numbers_[i] != 0.0) {
      return false;
    }
  }
  return true;
}

SettingInfo speedTableSetting(const std::string& name, const std::string& meaning,
                              std::vector<ColumnInfo> columns) {
  SettingInfo info{name, SettingKind::kTable, "", meaning};
  info.columns = std::move(columns);
  info.columns.insert(info.columns.begin(), {"speed", "rad/s", Range::kNotNegative,
                                             std::numeric_limits<double>::quiet_NaN()});
  return info;
}

}  // namespace whirl_twin
