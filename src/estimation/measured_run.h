// A recorded run: columns of numbers over time, and anomalies of the data.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whirl_twin {

struct MeasuredColumn {
  std::string name;
  std::vector<double> values;  ///< one per row
};

struct MeasuredRun {
  std::vector<double> time;  ///< [s], ascending
  std::vector<MeasuredColumn> columns;
  /// Remarks for the user, with rows: the first row below the names is row 1.
  std::vector<std::string> remarks;

  /// Throws std::logic_error if there is no column of that name.
  const std::vector<double>& column(const std::string& name) const;
  double duration() const { return time.back() - time.front(); }
  double usualStep() const;  ///< [s], the median
};

/// Makes a run of columns, sorted by time. Rows with the instant [s] of the row before are omitted.
/// Remarks report these, a time that goes back, gaps, uneven steps, and columns that are constant,
/// clipped at an end of their range, or coarsely quantized. Throws InputError with the error and
/// its place: rows of two runs, fewer than five rows.
MeasuredRun measuredRun(std::vector<double> time, std::vector<MeasuredColumn> columns);

/// Likewise from the columns of a CSV file with a header line. If the file ends within a line, its
/// last row is omitted, with a remark: its last number may be cut. Throws InputError, also for
/// errors of csvColumns().
MeasuredRun readMeasuredRun(const std::string& path, const std::string& time,
                            const std::vector<std::string>& columns);

}  // namespace whirl_twin
