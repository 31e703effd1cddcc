#include "estimation/run_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "scene/table_cells.h"
#include "signal/outliers.h"

namespace whirl_twin {

namespace {

constexpr double kWithinATurn = 1.01;    // turns; an encoder's noise may exceed one
constexpr double kMaxTurnsCounted = 10;  // of multi-turn encoders; more are degrees
constexpr double kSureStep = 0.7 * kPi;  // rad, of unambiguous direction
constexpr double kLongGap = 5.0;         // of the usual step
constexpr double kLongStep = 1.5;        // likewise: the angle between is not sampled
constexpr double kShortStep = 0.5;       // likewise: too short for a rate

double withoutTurns(double step) {
  return step - kTwoPi * std::round(step / kTwoPi);
}

/// Differences of a column between consecutive rows.
class AngleSteps {
 public:
  AngleSteps(const std::vector<double>& time, const std::vector<double>& x, double usual)
      : time_(time), x_(x), usual_(usual) {}

  std::size_t count() const { return x_.size(); }  // the first is step 1
  double of(std::size_t i) const { return x_[i] - x_[i - 1]; }
  double duration(std::size_t i) const { return time_[i] - time_[i - 1]; }
  bool isJump(std::size_t i) const { return std::fabs(of(i)) > kPi; }
  bool isOverGap(std::size_t i) const { return duration(i) > kLongGap * usual_; }
  /// Slow before and after the jump, and the jump is small without a turn.
  bool isAlone(std::size_t i) const {
    return isSure(withoutTurns(of(i))) && (i < 2 || isOverGap(i - 1) || isSure(of(i - 1))) &&
           (i + 1 == count() || isOverGap(i + 1) || isSure(of(i + 1)));
  }
  bool isSampled(std::size_t i) const { return duration(i) <= kLongStep * usual_; }
  static bool isSure(double step) { return std::fabs(step) <= kSureStep; }

  /// Largest rate [rad/s] between rows.
  double fastest() const {
    double rate = 0.0;
    for (std::size_t i = 1; i < count(); ++i) {
      if (isSampled(i) && duration(i) >= kShortStep * usual_) {
        rate = std::max(rate, std::fabs(withoutTurns(of(i))) / duration(i));
      }
    }
    return rate;
  }

 private:
  const std::vector<double>& time_;
  const std::vector<double>& x_;
  double usual_;
};

/// Throws InputError if jumps occur only in gaps: it cannot be decided.
bool isWrapped(const AngleSteps& steps, const std::vector<double>& time, double range,
               const std::string& column) {
  const bool within = range <= kWithinATurn * kTwoPi;
  std::size_t jumps = 0, over_gap = 0;
  for (std::size_t i = 1; i < steps.count(); ++i) {
    if (steps.isJump(i) && steps.isOverGap(i)) {
      over_gap = i;
    } else if (steps.isJump(i)) {
      if (!within && !steps.isAlone(i)) {
        return false;  // a genuine motion, that large from row to row
      }
      ++jumps;
    }
  }
  if (jumps == 0 && over_gap > 0 && within) {
    throw InputError(
        fmt::format("column {}: jumps by {:.3g} rad in the gap before {:.9g} s: set `wrap: true` "
                    "if the angle is within one turn, `wrap: false` if it counts turns",
                    inQuotes(column), steps.of(over_gap), time[over_gap]));
  }
  return jumps > 0 && range <= kMaxTurnsCounted * kTwoPi;
}

void requireDirections(const AngleSteps& steps, const std::vector<double>& time,
                       const std::string& column) {
  const double fastest = steps.fastest();
  for (std::size_t i = 1; i < steps.count(); ++i) {
    const double step = withoutTurns(steps.of(i));
    if (steps.isSampled(i) && !AngleSteps::isSure(step)) {
      throw InputError(
          fmt::format("column {}: a wrapped angle moves by {:.3g} rad from one row to the next, at "
                      "{:.9g} s: must have at least three rows per turn, or the direction is "
                      "unknown (`wrap: false` does not unwrap it)",
                      inQuotes(column), step, time[i]));
    }
    if (!steps.isSampled(i) && fastest * steps.duration(i) > kPi) {
      throw InputError(fmt::format(
          "column {}: a wrapped angle may have turned further in the gap of {:.4g} s before {:.9g} "
          "s: must have no gap; give the rows before and after it as two runs",
          inQuotes(column), steps.duration(i), time[i]));
    }
  }
}

}  // namespace

void unwrapTurns(MeasuredRun& run, const MeasuredChannel& channel) {
  const auto column =
      std::find_if(run.columns.begin(), run.columns.end(),
                   [&](const MeasuredColumn& c) { return c.name == channel.column; });
  std::vector<double>& x = column->values;
  if (channel.unit != "rad" || x.size() < 2 || !channel.wrap.value_or(true)) {
    return;
  }
  const AngleSteps steps(run.time, x, run.usualStep());
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  if (!channel.wrap && !isWrapped(steps, run.time, *most - *least, channel.column)) {
    return;
  }
  requireDirections(steps, run.time, channel.column);
  double turns = 0.0, before = x.front();
  std::size_t jumps = 0, first = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double step = x[i] - before;
    before = x[i];
    const double jumped = std::round(step / kTwoPi);
    first = jumped != 0.0 && jumps++ == 0 ? i : first;
    turns -= jumped;
    x[i] += kTwoPi * turns;
  }
  if (jumps > 0) {
    run.remarks.push_back(fmt::format(
        "{} is a wrapped angle: {} {} of whole turns unwrapped, the first at {:.9g} s "
        "(`wrap: false` does not unwrap it)",
        inQuotes(channel.column), jumps, jumps == 1 ? "jump" : "jumps", run.time[first]));
  }
}

namespace {

constexpr double kMost = 1.0e6;  // of a channel's unit: rad, m, rad/s, m/s
constexpr double kManyTurns = 10.0;
constexpr double kManySteps = 1000.0;  // of the scene, from row to row
constexpr int kMinInWindow = 5;        // rows

class Columns {
 public:
  explicit Columns(MeasuredRun& run) : run_(run) {}

  void bring(const std::string& name, const std::string& what, const std::string& wanted) {
    const auto column = std::find_if(run_.columns.begin(), run_.columns.end(),
                                     [&](const MeasuredColumn& c) { return c.name == name; });
    const std::string unit = column->unit.empty() ? columnOfHeading(name).unit : column->unit;
    if (unit.empty() || !done_.insert(name).second) {
      return;
    }
    const double scale = unitScale(unit, wanted);
    if (scale == 0.0) {
      throw InputError(
          fmt::format("column {}: the unit is {}, but {} must be in {} or another unit of that "
                      "kind",
                      inQuotes(name), printable(unit), what, wanted));
    }
    for (double& value : column->values) {
      value *= scale;
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
      throw InputError(fmt::format("column {}: {} must be within {:g} {}, found {:g} at {:.9g} s",
                                   inQuotes(channel.column), channel.name, kMost, channel.unit,
                                   x[i], run.time[i]));
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
        inQuotes(channel.column), *most - *least, (*most - *least) / kTwoPi));
  } else if (leap > 0.5 * kTwoPi) {
    run.remarks.push_back(fmt::format(
        "{} jumps by {:.3g} rad from one row to the next, at {:.9g} s: wrapped at a turn, or in "
        "degrees?",
        inQuotes(channel.column), leap, run.time[leaps_at]));
  }
}

/// Are all its measured columns constant?
bool standsStill(const StudyRun& run) {
  return std::all_of(run.measured.begin(), run.measured.end(), [&](const MeasuredChannel& c) {
    const std::vector<double>& x = run.data.column(c.column);
    return std::all_of(x.begin(), x.end(), [&](double value) { return value == x.front(); });
  });
}

/// Replaces outliers by the mean of the neighbouring rows.
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
                  inQuotes(name), wild.size(), wild.size() == 1 ? "sample" : "samples",
                  x[wild.front()], run.time[wild.front()]));
  for (const std::size_t i : wild) {
    const double after = x[i + 1];
    const bool jumps = std::fabs(after - x[i - 1]) > kPi;  // a wrapped angle
    x[i] = jumps ? x[i - 1] : 0.5 * (x[i - 1] + after);
  }
}

}  // namespace

void settleUnits(StudyRun& run, const std::vector<InputInfo>& inputs, double step_seconds) {
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
    throw InputError(
        "the measurements must change during a run, found the same values in every row");
  }
  const double usual = run.data.usualStep();
  if (kMinInWindow * usual > window * (1.0 + 1.0e-9)) {
    throw InputError(
        fmt::format("rows are {:.4g} s apart, so windows of {:g} s have fewer than {}: use longer "
                    "windows, or the time in s",
                    usual, window, kMinInWindow));
  }
}

}  // namespace whirl_twin
