#include "estimation/measured_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/csv_columns.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMinRows = 5;
constexpr double kGap = 5.0;            // of the usual step
constexpr double kUneven = 0.2;         // of the usual step
constexpr double kStuckSeconds = 0.25;  // of one value while the column moves elsewhere
constexpr std::size_t kStuckRows = 20;  // likewise
constexpr double kCoarse = 1.0e-3;      // of the range
constexpr double kAlternating = 3.0;    // ratio to the variation of the unsorted rows
constexpr double kLatest = 4.2e9;       // s: 32-bit time stamps end in 2106

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
  double sum = 0.0;
  for (std::size_t i = 1; i < column.values.size(); ++i) {
    sum += std::fabs(column.values[i] - column.values[i - 1]);
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
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return of_file.time[a] < of_file.time[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    run.time[i] = of_file.time[order[i]];
    rows[i] = order[i] + 1;
    for (std::size_t c = 0; c < run.columns.size(); ++c) {
      run.columns[c].values[i] = of_file.columns[c].values[order[i]];
    }
  }
  for (const MeasuredColumn& column : run.columns) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (run.time[i] == run.time[i - 1] && column.values[i] != column.values[i - 1]) {
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

void remarkOnColumn(const MeasuredRun& run, const std::vector<std::size_t>& rows,
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
  const std::set<double> distinct(column.values.begin(), column.values.end());
  double finest = range;
  for (auto a = distinct.begin(), b = std::next(a); b != distinct.end(); ++a, ++b) {
    finest = std::min(finest, *b - *a);
  }
  if (count >= kStuckRows && run.time[from + count - 1] - run.time[from] > kStuckSeconds) {
    const bool at_end = value == *least || value == *most;
    remarks.push_back(fmt::format("{} stays at {:.9g} for {:.3g} s from row {} on{}", name, value,
                                  run.time[from + count - 1] - run.time[from], rows[from],
                                  at_end ? ", an end of its range: saturated?" : ": stuck?"));
  }
  if (finest > kCoarse * range) {
    remarks.push_back(fmt::format("{} comes in steps of {:.4g}, {:.2g} % of its range", name,
                                  finest, 100.0 * finest / range));
  }
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

MeasuredRun readMeasuredRun(const std::string& path, const std::string& time,
                            const std::vector<std::string>& columns) {
  std::vector<std::string> names = {time};
  names.insert(names.end(), columns.begin(), columns.end());
  bool cut = false;
  std::vector<std::vector<double>> read = csvColumns(path, names, &cut);
  std::vector<MeasuredColumn> named;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    named.push_back({columns[i], std::move(read[i + 1])});
  }
  MeasuredRun run = measuredRun(std::move(read.front()), std::move(named));
  if (cut) {
    run.remarks.emplace_back("the file ends within a line: its last row is left out");
  }
  return run;
}

MeasuredRun measuredRun(std::vector<double> time, std::vector<MeasuredColumn> columns) {
  MeasuredRun run;
  run.time = std::move(time);
  run.columns = std::move(columns);
  std::vector<std::size_t> rows(run.time.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = i + 1;
  }
  sortByTime(run, rows);
  keepAscending(run, rows);
  if (run.time.size() < kMinRows) {
    throw InputError(fmt::format("must have {} rows of different instants, found {}", kMinRows,
                                 run.time.size()));
  }
  remarkOnTime(run, rows);
  for (const MeasuredColumn& column : run.columns) {
    remarkOnColumn(run, rows, column, run.remarks);
  }
  return run;
}

}  // namespace whirl_twin
