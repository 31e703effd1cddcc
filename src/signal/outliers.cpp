#include "signal/outliers.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

constexpr double kWild = 12.0;
constexpr std::size_t kFewest = 24;  // distances, before which nothing is usual
constexpr double kMaxWild = 0.01;
constexpr double kForgetting = 1.0 / 500.0;

double medianOfThree(const double* a) {
  return std::max(std::min(a[0], a[1]), std::min(std::max(a[0], a[1]), a[2]));
}

}  // namespace

/// Of the sample three before the newest.
double WildSampleDetector::distance() const {
  const double value = values_[3];
  return std::fmin(std::fabs(value - medianOfThree(&values_[0])),
                   std::fabs(value - medianOfThree(&values_[4])));
}

std::optional<std::int64_t> WildSampleDetector::take(std::int64_t instant, double value) {
  const double change = taken_ > 0 ? std::fabs(value - values_.back()) : 0.0;
  if (change > 0.0 && (smallest_change_ == 0.0 || change < smallest_change_)) {
    smallest_change_ = change;
  }
  std::rotate(instants_.begin(), instants_.begin() + 1, instants_.end());
  std::rotate(values_.begin(), values_.begin() + 1, values_.end());
  instants_.back() = instant;
  values_.back() = value;
  if (++taken_ < values_.size()) {
    return std::nullopt;
  }
  std::rotate(distances_.begin(), distances_.begin() + 1, distances_.end());
  distances_.back() = distance();
  // The sample under test is in the middle of the distances; its own is not in the statistics yet.
  const double own = distances_[3];
  bool wild = false;
  if (taken_ >= 2 * values_.size() - 1 && judged_ >= kFewest) {
    std::array<double, kBehind> others{distances_[0], distances_[1], distances_[2],
                                       distances_[4], distances_[5], distances_[6]};
    std::nth_element(others.begin(), others.begin() + 3, others.end());
    // The scale of all is computed only for the few that differ from their neighbours.
    const double near = std::fmax(others[3], smallest_change_);
    wild =
        own > kWild * near && own > kWild * robustScale(last_distances_, std::min(judged_, kUsual));
  }
  last_distances_[judged_++ % kUsual] = own;
  rate_ += kForgetting * ((wild ? 1.0 : 0.0) - rate_);
  if (!wild || rate_ > kMaxWild) {
    return std::nullopt;
  }
  ++found_;
  return instants_[0];
}

}  // namespace whirl_twin
