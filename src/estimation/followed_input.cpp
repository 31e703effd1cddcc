#include "estimation/followed_input.h"

#include <algorithm>
#include <iterator>

namespace whirl_twin {

namespace {

/// Between samples further apart nobody knows what acted: the first of them stays.
constexpr double kLongestLine = 0.25;  // s

double secondsBetween(std::int64_t from, std::int64_t to) {
  return 1.0e-9 * static_cast<double>(to - from);
}

}  // namespace

void FollowedInput::take(const InputSample& sample) {
  if (!samples_.empty() && sample.time <= samples_.back().time) {
    return;
  }
  spacing_ = samples_.empty() ? 0.0 : secondsBetween(samples_.back().time, sample.time);
  samples_.push_back(sample);
}

void FollowedInput::forgetBefore(std::int64_t instant) {
  while (samples_.size() > 1 && samples_[1].time <= instant) {
    samples_.pop_front();
  }
}

double FollowedInput::at(std::int64_t instant, double offset) const {
  const auto next = std::find_if(
      std::next(samples_.begin()), samples_.end(),
      [&](const InputSample& sample) { return secondsBetween(instant, sample.time) > offset; });
  const InputSample& last = *std::prev(next);
  if (hold_ || next == samples_.end()) {
    return last.value;
  }
  const double length = secondsBetween(last.time, next->time);
  const double part = std::max(0.0, (secondsBetween(last.time, instant) + offset) / length);
  return length > kLongestLine ? last.value : last.value + part * (next->value - last.value);
}

void FollowedInput::addCorners(std::int64_t from, std::int64_t to,
                               std::vector<std::int64_t>& corners) const {
  for (const InputSample& sample : samples_) {
    if (sample.time > from && sample.time < to) {
      corners.push_back(sample.time);
    }
  }
}

}  // namespace whirl_twin
