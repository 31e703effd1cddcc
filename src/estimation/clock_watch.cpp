#include "estimation/clock_watch.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

constexpr std::int64_t kWindow = 5'000'000'000;  // ns
constexpr std::size_t kWindows = 24;             // two minutes
constexpr std::size_t kFewest = 3;
constexpr double kDay = 86400.0;  // s
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) * 1.0e-9;
}

}  // namespace

void ClockWatch::take(std::int64_t machine, std::int64_t twin) {
  if (!began_) {
    began_ = true;
    first_ = machine - twin;
    first_twin_ = twin;
    window_start_ = twin;
  }
  if (twin - window_start_ >= kWindow) {
    windows_.push_back({seconds(window_start_ - first_twin_ + kWindow / 2), most_});
    if (windows_.size() > kWindows) {
      windows_.erase(windows_.begin());
    }
    window_start_ = twin;
    most_ = -std::numeric_limits<double>::infinity();
  }
  most_ = std::max(most_, seconds(machine - twin - first_));
}

void ClockWatch::restart() {
  windows_.clear();
  most_ = -std::numeric_limits<double>::infinity();
}

double ClockWatch::offset() const {
  if (windows_.empty()) {
    return kNaN;
  }
  const double first = seconds(first_);
  return windows_.back().most + (std::fabs(first) < kDay ? first : 0.0);
}

double ClockWatch::drift() const {
  if (windows_.size() < kFewest) {
    return kNaN;
  }
  double t = 0.0, x = 0.0;
  for (const Window& w : windows_) {
    t += w.middle;
    x += w.most;
  }
  const auto n = static_cast<double>(windows_.size());
  double tt = 0.0, tx = 0.0;
  for (const Window& w : windows_) {
    tt += (w.middle - t / n) * (w.middle - t / n);
    tx += (w.middle - t / n) * (w.most - x / n);
  }
  return tx / tt;
}

/// What windows differ by beyond the drift.
double ClockWatch::deviation() const {
  if (windows_.size() < kFewest) {
    return kNaN;
  }
  const double slope = drift();
  double squares = 0.0, sum = 0.0;
  for (const Window& w : windows_) {
    const double rest = w.most - slope * w.middle;
    sum += rest;
    squares += rest * rest;
  }
  const auto n = static_cast<double>(windows_.size());
  return std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 2.0));
}

}  // namespace whirl_twin
