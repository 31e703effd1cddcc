// A run as it was recorded: columns of numbers over time, and what is odd about them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whirl_twin {

struct MeasuredColumn {
  std::string name;
  std::vector<double> values;  ///< one a row
};

struct MeasuredRun {
  std::vector<double> time;  ///< [s], ascending
  std::vector<MeasuredColumn> columns;
  /// What a reader should know, with its rows: the first below the names is row 1.
  std::vector<std::string> remarks;

  /// Throws std::logic_error where there is none of that name.
  const std::vector<double>& column(const std::string& name) const;
  double duration() const { return time.back() - time.front(); }
  double usualStep() const;  ///< [s], the median
};

/// A run of columns as they came, in the order of their instants. Rows that repeat the instant [s]
/// of the one before are left out, and that is remarked, as are a time that goes back, gaps, uneven
/// steps, and columns that stand still, stay at an end of their range, or come in coarse steps.
/// Throws Refusal with what is wrong and where: rows of two runs, fewer than five rows.
MeasuredRun measuredRun(std::vector<double> time, std::vector<MeasuredColumn> columns);

/// The same of columns in a file of comma-separated values with a line of names. Throws Refusal
/// for what csvColumns() refuses, too.
MeasuredRun readMeasuredRun(const std::string& path, const std::string& time,
                            const std::vector<std::string>& columns);

}  // namespace whirl_twin
