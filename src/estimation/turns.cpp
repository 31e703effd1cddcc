#include "estimation/turns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "messages/names.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr double kWithinATurn = 1.01;     // turns; an encoder's noise may lie beyond one
constexpr double kMostTurnsCounted = 10;  // by encoders of several turns; more are degrees
constexpr double kSureStep = 0.7 * kPi;   // rad, whose direction is known
constexpr double kLongGap = 5.0;          // of the usual step
constexpr double kLongStep = 1.5;         // likewise: the angle between is not sampled
constexpr double kShortStep = 0.5;        // likewise: too short to tell a rate

double withoutTurns(double step) {
  return step - kTwoPi * std::round(step / kTwoPi);
}

/// The steps of a column from row to row.
class AngleSteps {
 public:
  AngleSteps(const std::vector<double>& time, const std::vector<double>& x, double usual)
      : time_(time), x_(x), usual_(usual) {}

  std::size_t count() const { return x_.size(); }  // the first is step 1
  double of(std::size_t i) const { return x_[i] - x_[i - 1]; }
  double duration(std::size_t i) const { return time_[i] - time_[i - 1]; }
  bool isJump(std::size_t i) const { return std::fabs(of(i)) > kPi; }
  bool isOverGap(std::size_t i) const { return duration(i) > kLongGap * usual_; }
  /// Before and after a jump it moves slowly, and with a turn less so does the jump.
  bool isAlone(std::size_t i) const {
    return isSure(withoutTurns(of(i))) && (i < 2 || isOverGap(i - 1) || isSure(of(i - 1))) &&
           (i + 1 == count() || isOverGap(i + 1) || isSure(of(i + 1)));
  }
  bool isSampled(std::size_t i) const { return duration(i) <= kLongStep * usual_; }
  static bool isSure(double step) { return std::fabs(step) <= kSureStep; }

  /// [rad/s], the fastest from row to row.
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

/// Throws Refusal where the only jumps are in gaps: both may be.
bool isWrapped(const AngleSteps& steps, const std::vector<double>& time, double range,
               const std::string& column) {
  const bool within = range <= kWithinATurn * kTwoPi;
  std::size_t jumps = 0, over_gap = 0;
  for (std::size_t i = 1; i < steps.count(); ++i) {
    if (steps.isJump(i) && steps.isOverGap(i)) {
      over_gap = i;
    } else if (steps.isJump(i)) {
      if (!within && !steps.isAlone(i)) {
        return false;  // it turns by that much from row to row
      }
      ++jumps;
    }
  }
  if (jumps == 0 && over_gap > 0 && within) {
    throw Refusal(
        fmt::format("column {}: jumps by {:.3g} rad in the gap before {:.9g} s: set `wrap: true` "
                    "if the angle is within one turn, `wrap: false` if it counts turns",
                    quoted(column), steps.of(over_gap), time[over_gap]));
  }
  return jumps > 0 && range <= kMostTurnsCounted * kTwoPi;
}

void requireDirections(const AngleSteps& steps, const std::vector<double>& time,
                       const std::string& column) {
  const double fastest = steps.fastest();
  for (std::size_t i = 1; i < steps.count(); ++i) {
    const double step = withoutTurns(steps.of(i));
    if (steps.isSampled(i) && !AngleSteps::isSure(step)) {
      throw Refusal(
          fmt::format("column {}: a wrapped angle moves by {:.3g} rad from one row to the next, at "
                      "{:.9g} s: must have at least three rows per turn, or the direction is "
                      "unknown (`wrap: false` does not unwrap it)",
                      quoted(column), step, time[i]));
    }
    if (!steps.isSampled(i) && fastest * steps.duration(i) > kPi) {
      throw Refusal(fmt::format(
          "column {}: a wrapped angle may have turned further in the gap of {:.4g} s before {:.9g} "
          "s: must have no gap; give the rows before and after it as two runs",
          quoted(column), steps.duration(i), time[i]));
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
    run.remarks.push_back(
        fmt::format("{} is a wrapped angle: {} {} of whole turns unwrapped, the first at {:.9g} s "
                    "(`wrap: false` does not unwrap it)",
                    quoted(channel.column), jumps, jumps == 1 ? "jump" : "jumps", run.time[first]));
  }
}

}  // namespace whirl_twin
