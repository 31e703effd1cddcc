// A recorded run: columns of numbers over time, and anomalies of the data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/table_reader.h"

namespace whirl_twin {

struct MeasuredColumn {
  std::string name;
  std::vector<double> values;  ///< one per row; NaN: a gap
  std::string unit = "";       ///< as the file gives it; "": not given
};

/// What is required of a file.
struct WantedColumn {
  /// What becomes of a row without a number in the column: it is left out, or the number is that of
  /// the line between its neighbours, or of the row before.
  enum class Gap { kLeftOut, kInterpolated, kHeld };
  std::string name;
  Gap gap = Gap::kLeftOut;
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
/// its place: rows of two runs, fewer than five rows. rows: their numbers in the file; empty: from
/// 1 on.
MeasuredRun measuredRun(std::vector<double> time, std::vector<MeasuredColumn> columns,
                        std::vector<std::size_t> rows = {});

/// Rows of a table, in memory.
struct TableRows {
  std::vector<std::int64_t> instants;  ///< [ns]
  std::vector<std::size_t> numbers;    ///< of the rows, from 1 on
  std::vector<MeasuredColumn> columns;
  std::size_t count = 0;  ///< of rows, with those that are left out: without an instant or a number
  bool whole = true;      ///< there are no more
  /// [s], from the first row on where the instants are of a calendar.
  std::vector<double> time() const;
  std::int64_t origin() const;  ///< [ns], of it
};
/// At most so many numbers; the columns are those of selectOverTime().
TableRows readRows(NumberTable& table, std::vector<MeasuredColumn> columns,
                   std::size_t max_numbers);

/// Likewise from a table, by heading or name (scene/table_reader.h). Instants of a calendar count
/// from the first row. If the file ends within a line, its last row is omitted, with a remark: its
/// last number may be cut. Throws InputError, also for errors of TableReader.
MeasuredRun readMeasuredRun(const std::string& path, const TableSettings& settings,
                            const std::vector<WantedColumn>& columns);

}  // namespace whirl_twin
