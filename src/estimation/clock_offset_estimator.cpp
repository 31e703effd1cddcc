#include "estimation/clock_offset_estimator.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kClockWindow = 5'000'000'000;  // ns
constexpr std::size_t kWindows = 24;                  // two minutes
constexpr std::size_t kMinClockWindows = 6;
constexpr double kSure = 1.0e-4;  // standard deviation of a drift
constexpr double kDay = 86400.0;  // s

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) * kNanosecond;
}

}  // namespace

void ClockOffsetEstimator::take(std::int64_t machine, std::int64_t twin) {
  if (!began_) {
    began_ = true;
    first_ = machine - twin;
    first_twin_ = twin;
    window_start_ = twin;
  }
  if (twin - window_start_ >= kClockWindow) {
    windows_.push_back({seconds(window_start_ - first_twin_ + kClockWindow / 2), most_});
    if (windows_.size() > kWindows) {
      windows_.erase(windows_.begin());
    }
    window_start_ = twin;
    most_ = -std::numeric_limits<double>::infinity();
  }
  most_ = std::max(most_, seconds(machine - twin - first_));
}

void ClockOffsetEstimator::restart() {
  windows_.clear();
  most_ = -std::numeric_limits<double>::infinity();
  if (std::fabs(seconds(first_)) >= kDay) {
    began_ = false;
  }
}

double ClockOffsetEstimator::offset() const {
  if (windows_.empty()) {
    return kNaN;
  }
  const double first = seconds(first_);
  return windows_.back().most + (std::fabs(first) < kDay ? first : 0.0);
}

ClockOffsetEstimator::Line ClockOffsetEstimator::line() const {
  double t = 0.0, x = 0.0;
  for (const Window& w : windows_) {
    t += w.middle;
    x += w.most;
  }
  const auto n = static_cast<double>(windows_.size());
  double tt = 0.0, tx = 0.0, xx = 0.0;
  for (const Window& w : windows_) {
    tt += (w.middle - t / n) * (w.middle - t / n);
    tx += (w.middle - t / n) * (w.most - x / n);
    xx += (w.most - x / n) * (w.most - x / n);
  }
  const double deviation = std::sqrt(std::max(0.0, xx - tx * tx / tt) / (n - 2.0));
  return {tx / tt, deviation, deviation / std::sqrt(tt)};
}

double ClockOffsetEstimator::drift() const {
  if (windows_.size() < kMinClockWindows) {
    return kNaN;
  }
  const Line through = line();
  return through.slope_deviation < kSure ? through.slope : kNaN;
}

/// Scatter of the windows about the line.
double ClockOffsetEstimator::deviation() const {
  return windows_.size() < kMinClockWindows ? kNaN : line().deviation;
}

}  // namespace whirl_twin
