#include "estimation/measured_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "estimation/uff_file.h"
#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMinRows = 5;
constexpr double kGap = 5.0;                      // of the usual step
constexpr double kUneven = 0.2;                   // of the usual step
constexpr double kStuckSeconds = 0.25;            // of one value while the column moves elsewhere
constexpr std::size_t kStuckRows = 20;            // likewise
constexpr double kCoarse = 1.0e-3;                // of the range
constexpr double kAlternating = 3.0;              // ratio to the variation of the unsorted rows
constexpr double kLatest = 4.2e9;                 // s: 32-bit time stamps end in 2106
constexpr std::size_t kMaxNumbers = 100'000'000;  // in memory
constexpr std::int64_t kOfCalendar = 1'000'000'000'000'000;  // ns: such a time counts from 1970
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double median(std::vector<double> x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

std::vector<double> stepsOf(const std::vector<double>& time) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) {
    steps.push_back(time[i] - time[i - 1]);
  }
  return steps;
}

/// Total variation over consecutive rows, whichever way their time runs: a file may be written
/// from the newest row to the oldest.
double variation(const MeasuredColumn& column) {
  double sum = 0.0, before = std::numeric_limits<double>::quiet_NaN();
  for (const double value : column.values) {
    sum += std::isnan(value - before) ? 0.0 : std::fabs(value - before);
    before = std::isnan(value) ? before : value;
  }
  return sum;
}

/// Sorts rows by time. Throws InputError if they cannot be one run: two different rows at an
/// instant, or values that alternate between two motions.
void sortByTime(MeasuredRun& run, std::vector<std::size_t>& rows) {
  std::size_t back = 0, first_back = 0;
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    if (!(std::fabs(run.time[i]) <= kLatest)) {
      throw InputError(fmt::format("row {0}: the time must be from -{1:g} to {1:g} s, found {2:g}",
                                   rows[i], kLatest, run.time[i]));
    }
    if (i > 0 && run.time[i] < run.time[i - 1]) {
      first_back = back++ == 0 ? i : first_back;
    }
  }
  if (back == 0) {
    return;
  }
  const std::string where =
      fmt::format("row {}: the time goes back, from {:.9g} s to {:.9g} s, and ", rows[first_back],
                  run.time[first_back - 1], run.time[first_back]);
  const MeasuredRun of_file = run;
  const std::vector<std::size_t> rows_of_file = rows;
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return of_file.time[a] < of_file.time[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    run.time[i] = of_file.time[order[i]];
    rows[i] = rows_of_file[order[i]];
    for (std::size_t c = 0; c < run.columns.size(); ++c) {
      run.columns[c].values[i] = of_file.columns[c].values[order[i]];
    }
  }
  for (const MeasuredColumn& column : run.columns) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (run.time[i] == run.time[i - 1] &&
          std::fabs(column.values[i] - column.values[i - 1]) > 0.0) {
        throw InputError(fmt::format(
            "{}rows {} and {} have different values of {} at {:.9g} s: must be one run, found two",
            where, rows[i - 1], rows[i], inQuotes(column.name), run.time[i]));
      }
    }
  }
  for (std::size_t c = 0; c < run.columns.size(); ++c) {
    if (variation(run.columns[c]) > kAlternating * variation(of_file.columns[c])) {
      throw InputError(fmt::format(
          "{}in the order of time {} alternates between two motions: must be one run, found two",
          where, inQuotes(run.columns[c].name)));
    }
  }
  run.remarks.push_back(
      fmt::format("the time goes back at {} {}, the first is row {}: sorted by time", back,
                  back == 1 ? "row" : "rows", first_back + 1));
}

/// Keeps the rows that are later than all before; `rows`: their original numbers.
void keepAscending(MeasuredRun& run, std::vector<std::size_t>& rows) {
  std::size_t kept = 0;
  std::size_t repeated = 0;
  std::size_t first_repeated = 0;
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    if (kept > 0 && run.time[i] == run.time[kept - 1]) {
      first_repeated = repeated++ == 0 ? rows[i] : first_repeated;
      continue;
    }
    run.time[kept] = run.time[i];
    rows[kept] = rows[i];
    for (MeasuredColumn& column : run.columns) {
      column.values[kept] = column.values[i];
    }
    ++kept;
  }
  run.time.resize(kept);
  rows.resize(kept);
  for (MeasuredColumn& column : run.columns) {
    column.values.resize(kept);
  }
  if (repeated > 0) {
    run.remarks.push_back(
        fmt::format("{} {} at the same instant as the one before, left out; the first is row {}",
                    repeated, repeated == 1 ? "row" : "rows", first_repeated));
  }
}

void remarkOnTime(MeasuredRun& run, const std::vector<std::size_t>& rows) {
  const std::vector<double> steps = stepsOf(run.time);
  const double usual = median(steps);
  const auto widest = std::max_element(steps.begin(), steps.end());
  const auto gaps =
      std::count_if(steps.begin(), steps.end(), [&](double step) { return step > kGap * usual; });
  if (gaps > 0) {
    run.remarks.push_back(
        fmt::format("{} {} of more than {:g} steps of {:.4g} s; the widest, {:.4g} "
                    "s, before row {}",
                    gaps, gaps == 1 ? "gap" : "gaps", kGap, usual, *widest,
                    rows[static_cast<std::size_t>(widest - steps.begin()) + 1]));
  }
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  if (gaps == 0 && *most - *least > kUneven * usual) {
    run.remarks.push_back(
        fmt::format("uneven steps, {:.4g} to {:.4g} s: used unchanged", *least, *most));
  }
}

/// The longest sequence of equal values: first row and count.
std::pair<std::size_t, std::size_t> longestStretch(const std::vector<double>& values) {
  std::pair<std::size_t, std::size_t> longest{0, 0};
  std::size_t from = 0;
  for (std::size_t i = 1; i <= values.size(); ++i) {
    if (i == values.size() || values[i] != values[from]) {
      if (i - from > longest.second) {
        longest = {from, i - from};
      }
      from = i;
    }
  }
  return longest;
}

/// Of a column without gaps.
void remarkOnColumn(const std::vector<double>& time, const std::vector<std::size_t>& rows,
                    const MeasuredColumn& column, std::vector<std::string>& remarks) {
  const std::string name = inQuotes(column.name);
  const auto [least, most] = std::minmax_element(column.values.begin(), column.values.end());
  const double range = *most - *least;
  if (range == 0.0) {
    remarks.push_back(fmt::format("{} is {:.9g} in every row", name, *least));
    return;
  }
  const auto [from, count] = longestStretch(column.values);
  const double value = column.values[from];
  std::vector<double> sorted = column.values;
  std::sort(sorted.begin(), sorted.end());
  double finest = range;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    finest = sorted[i] > sorted[i - 1] ? std::min(finest, sorted[i] - sorted[i - 1]) : finest;
  }
  if (count >= kStuckRows && time[from + count - 1] - time[from] > kStuckSeconds) {
    const bool at_end = value == *least || value == *most;
    remarks.push_back(fmt::format("{} stays at {:.9g} for {:.3g} s from row {} on{}", name, value,
                                  time[from + count - 1] - time[from], rows[from],
                                  at_end ? ", an end of its range: saturated?" : ": stuck?"));
  }
  if (finest > kCoarse * range) {
    remarks.push_back(fmt::format("{} comes in steps of {:.4g}, {:.2g} % of its range", name,
                                  finest, 100.0 * finest / range));
  }
}

/// Gaps of columns that are not left out, by the rows that have a number there, whatever the order.
void fillGaps(const std::vector<double>& time, const std::vector<WantedColumn>& wanted,
              std::vector<MeasuredColumn>& columns) {
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    std::vector<double>& values = columns[c].values;
    std::vector<std::pair<double, double>> known;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isnan(values[i])) {
        known.emplace_back(time[i], values[i]);
      }
    }
    if (wanted[c].gap == WantedColumn::Gap::kLeftOut || known.empty() ||
        known.size() == values.size()) {
      continue;
    }
    std::stable_sort(known.begin(), known.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isnan(values[i])) {
        continue;
      }
      const auto after =
          std::upper_bound(known.begin(), known.end(), std::pair(time[i], kInfinity));
      const auto before = after == known.begin() ? after : after - 1;
      const bool held =
          after == known.end() || before == after || wanted[c].gap == WantedColumn::Gap::kHeld;
      values[i] = held ? before->second
                       : before->second + (after->second - before->second) *
                                              (time[i] - before->first) /
                                              (after->first - before->first);
    }
  }
}

/// Throws InputError for a column without numbers.
void leaveOutGaps(std::vector<double>& time, std::vector<MeasuredColumn>& columns,
                  std::vector<std::size_t>& rows) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (std::any_of(columns.begin(), columns.end(),
                    [&](const MeasuredColumn& column) { return std::isnan(column.values[i]); })) {
      continue;
    }
    time[kept] = time[i];
    rows[kept] = rows[i];
    for (MeasuredColumn& column : columns) {
      column.values[kept] = column.values[i];
    }
    ++kept;
  }
  for (MeasuredColumn& column : columns) {
    if (kept == 0 && !column.values.empty() &&
        std::all_of(column.values.begin(), column.values.end(),
                    [](double value) { return std::isnan(value); })) {
      throw InputError(fmt::format("column {} has no numbers", inQuotes(column.name)));
    }
    column.values.resize(kept);
  }
  time.resize(kept);
  rows.resize(kept);
}

}  // namespace

double MeasuredRun::usualStep() const {
  return median(stepsOf(time));
}

const std::vector<double>& MeasuredRun::column(const std::string& name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const MeasuredColumn& c) { return c.name == name; });
  if (found == columns.end()) {
    throw std::logic_error("no column " + name + " was read");
  }
  return found->values;
}

std::int64_t TableRows::origin() const {
  return !instants.empty() && std::abs(instants.front()) > kOfCalendar ? instants.front() : 0;
}

std::vector<double> TableRows::time() const {
  std::vector<double> seconds;
  for (const std::int64_t instant : instants) {
    seconds.push_back(1.0e-9 * static_cast<double>(instant - origin()));
  }
  return seconds;
}

TableRows readRows(NumberTable& table, std::vector<MeasuredColumn> columns,
                   std::size_t max_numbers) {
  TableRows rows;
  rows.columns = std::move(columns);
  const auto isGap = [](double value) { return std::isnan(value); };
  for (std::vector<double> row; table.next(row);) {
    ++rows.count;
    if (table.hasInstant() && !std::all_of(row.begin(), row.end(), isGap)) {
      rows.instants.push_back(table.instant());
      rows.numbers.push_back(rows.count);
      for (std::size_t c = 0; c < row.size(); ++c) {
        rows.columns[c].values.push_back(row[c]);
      }
    }
    if (rows.count * row.size() >= max_numbers) {
      rows.whole = false;
      break;
    }
  }
  return rows;
}

MeasuredRun readMeasuredRun(const std::string& path, const TableSettings& settings,
                            const std::vector<WantedColumn>& wanted) {
  const std::unique_ptr<NumberTable> table = openNumberTable(path, settings);
  std::vector<std::size_t> places;
  std::vector<MeasuredColumn> columns;
  for (const WantedColumn& column : wanted) {
    places.push_back(table->column(column.name));
    columns.push_back({column.name, {}, table->columns()[places.back()].unit});
  }
  table->selectOverTime(places);
  TableRows rows = readRows(*table, std::move(columns), kMaxNumbers);
  if (!rows.whole) {
    throw InputError(fmt::format("must have at most {} numbers, the limit of a run", kMaxNumbers));
  }
  std::vector<double> time = rows.time();
  fillGaps(time, wanted, rows.columns);
  leaveOutGaps(time, rows.columns, rows.numbers);
  std::vector<std::string> remarks = table->remarks();
  if (time.size() < rows.count) {
    remarks.push_back(fmt::format("{} of {} rows are left out: without a number in a column",
                                  rows.count - time.size(), rows.count));
  }
  MeasuredRun run = measuredRun(std::move(time), std::move(rows.columns), std::move(rows.numbers));
  run.remarks.insert(run.remarks.end(), remarks.begin(), remarks.end());
  return run;
}

MeasuredRun measuredRun(std::vector<double> time, std::vector<MeasuredColumn> columns,
                        std::vector<std::size_t> rows) {
  MeasuredRun run;
  run.time = std::move(time);
  run.columns = std::move(columns);
  if (rows.empty()) {
    rows.resize(run.time.size());
    std::iota(rows.begin(), rows.end(), 1);
  }
  sortByTime(run, rows);
  keepAscending(run, rows);
  if (run.time.size() < kMinRows) {
    throw InputError(fmt::format("must have {} rows of different instants, found {}", kMinRows,
                                 run.time.size()));
  }
  remarkOnTime(run, rows);
  for (const MeasuredColumn& column : run.columns) {
    std::vector<double> time_of = run.time;
    std::vector<std::size_t> rows_of = rows;
    std::vector<MeasuredColumn> one = {column};
    leaveOutGaps(time_of, one, rows_of);
    remarkOnColumn(time_of, rows_of, one.front(), run.remarks);
  }
  return run;
}

}  // namespace whirl_twin
