#include "estimation/run_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "algebra/constants.h"
#include "estimation/turns.h"
#include "messages/names.h"
#include "messages/refusal.h"
#include "messages/units.h"
#include "signal/wild_samples.h"

namespace whirl_twin {

namespace {

constexpr double kMost = 1.0e6;  // of a channel's unit: rad, m, rad/s, m/s
constexpr double kManyTurns = 10.0;
constexpr double kManySteps = 1000.0;  // of the scene, from row to row
constexpr int kFewestInWindow = 5;     // rows

/// Of `q1[deg]`; "" where there is none.
std::string columnUnit(const std::string& column) {
  const std::size_t open = column.rfind('[');
  if (open == std::string::npos || column.back() != ']') {
    return "";
  }
  const std::string unit = column.substr(open + 1, column.size() - open - 2);
  // An index is none: `positions[0]`.
  return !unit.empty() && std::isalpha(static_cast<unsigned char>(unit.front())) != 0 &&
                 isUnit(unit)
             ? unit
             : "";
}

class Columns {
 public:
  explicit Columns(MeasuredRun& run) : run_(run) {}

  void bring(const std::string& name, const std::string& what, const std::string& wanted) {
    const std::string unit = columnUnit(name);
    if (unit.empty() || !done_.insert(name).second) {
      return;
    }
    const double scale = unitScale(unit, wanted);
    if (scale == 0.0) {
      throw Refusal(
          fmt::format("column {}: the unit is {}, but {} must be in {} or another unit of that "
                      "kind",
                      quoted(name), printable(unit), what, wanted));
    }
    for (MeasuredColumn& column : run_.columns) {
      for (double& value : column.values) {
        value *= column.name == name ? scale : 1.0;
      }
    }
  }

 private:
  MeasuredRun& run_;
  std::set<std::string> done_;
};

void judgeChannel(MeasuredRun& run, const MeasuredChannel& channel) {
  const std::vector<double>& x = run.column(channel.column);
  double leap = 0.0;
  std::size_t leaps_at = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(std::fabs(x[i]) <= kMost)) {
      throw Refusal(fmt::format("column {}: {} must be within {:g} {}, found {:g} at {:.9g} s",
                                quoted(channel.column), channel.name, kMost, channel.unit, x[i],
                                run.time[i]));
    }
    if (i > 0 && std::fabs(x[i] - x[i - 1]) > leap) {
      leap = std::fabs(x[i] - x[i - 1]);
      leaps_at = i;
    }
  }
  if (channel.unit != "rad") {
    return;
  }
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  if (*most - *least > kManyTurns * kTwoPi) {
    run.remarks.push_back(fmt::format(
        "{} ranges over {:.3g} rad, {:.3g} turns: is it in degrees? then write `q[deg]`",
        quoted(channel.column), *most - *least, (*most - *least) / kTwoPi));
  } else if (leap > 0.5 * kTwoPi) {
    run.remarks.push_back(fmt::format(
        "{} jumps by {:.3g} rad from one row to the next, at {:.9g} s: wrapped at a turn, or in "
        "degrees?",
        quoted(channel.column), leap, run.time[leaps_at]));
  }
}

/// Is each of its measured columns one number in all rows?
bool standsStill(const StudyRun& run) {
  return std::all_of(run.measured.begin(), run.measured.end(), [&](const MeasuredChannel& c) {
    const std::vector<double>& x = run.data.column(c.column);
    return std::all_of(x.begin(), x.end(), [&](double value) { return value == x.front(); });
  });
}

/// Puts the mean of the rows beside it in the place of a wild sample (wild_samples.h).
void replaceWildSamples(MeasuredRun& run, const std::string& name) {
  std::vector<double>& x =
      std::find_if(run.columns.begin(), run.columns.end(), [&](const MeasuredColumn& column) {
        return column.name == name;
      })->values;
  WildSampleDetector detector;
  std::vector<std::size_t> wild;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (const auto row = detector.take(static_cast<std::int64_t>(i), x[i])) {
      wild.push_back(static_cast<std::size_t>(*row));
    }
  }
  if (wild.empty()) {
    return;
  }
  run.remarks.push_back(
      fmt::format("{}: {} implausible {}, the first of {:.4g} at {:.9g} s: replaced by the mean of "
                  "the neighbouring rows",
                  quoted(name), wild.size(), wild.size() == 1 ? "sample" : "samples",
                  x[wild.front()], run.time[wild.front()]));
  for (const std::size_t i : wild) {
    const double after = x[i + 1];
    const bool jumps = std::fabs(after - x[i - 1]) > kPi;  // of an angle, to the next turn
    x[i] = jumps ? x[i - 1] : 0.5 * (x[i - 1] + after);
  }
}

}  // namespace

void settleUnits(StudyRun& run, const std::string& time, const std::vector<InputInfo>& inputs,
                 double step_seconds) {
  const std::string unit = columnUnit(time);
  if (!unit.empty() && unitScale(unit, "s") != 1.0) {
    throw Refusal(
        fmt::format("column {}: the time must be in s, found {}", quoted(time), printable(unit)));
  }
  Columns columns(run.data);
  for (const MeasuredChannel& channel : run.measured) {
    columns.bring(channel.column, channel.name, channel.unit);
  }
  for (const MeasuredInput& input : run.inputs) {
    columns.bring(input.column, input.name, inputs[input.place].unit);
  }
  for (const MeasuredChannel& channel : run.measured) {
    replaceWildSamples(run.data, channel.column);
    unwrapTurns(run.data, channel);
    judgeChannel(run.data, channel);
  }
  const double usual = run.data.usualStep();
  if (usual > kManySteps * step_seconds) {
    run.data.remarks.push_back(
        fmt::format("rows are {:.4g} s apart, {:.3g} steps of the scene: is the time in s?", usual,
                    usual / step_seconds));
  }
}

void requireUse(const StudyRun& run, double window) {
  if (run.train && standsStill(run)) {
    throw Refusal("the measurements must change during a run, found the same values in every row");
  }
  const double usual = run.data.usualStep();
  if (kFewestInWindow * usual > window * (1.0 + 1.0e-9)) {
    throw Refusal(
        fmt::format("rows are {:.4g} s apart, so windows of {:g} s have fewer than {}: use longer "
                    "windows, or the time in s",
                    usual, window, kFewestInWindow));
  }
}

}  // namespace whirl_twin
