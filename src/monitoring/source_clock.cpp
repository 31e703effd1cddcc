#include "monitoring/source_clock.h"

namespace whirl_twin {
namespace {

/// [s], simulated: lost states leave smaller gaps, if the source has not been silent.
constexpr double kLargestGap = 1.0;
/// A log may be played so many times faster than it was recorded, over a silence.
constexpr double kFastestPlay = 10.0;
/// [s], wall time: long beside what a network delays, short beside what an alarm waits for.
constexpr double kFollowAfter = 0.5;

}  // namespace

SourceClock::Order SourceClock::take(double time, double wall_time, double pace) {
  if (!newest_ || (time > newest_->time &&
                   time - newest_->time <=
                       pace * (kLargestGap + kFastestPlay * (wall_time - newest_->wall_time)))) {
    newest_ = {time, wall_time};
    other_.reset();
    return Order::kInStep;
  }
  if (time == newest_->time) {
    return Order::kOutOfStep;
  }
  if (!other_ || time <= other_->time) {
    other_since_ = wall_time;
  }
  other_ = {time, wall_time};
  if (wall_time - other_since_ < kFollowAfter) {
    return Order::kOutOfStep;
  }
  newest_ = other_;
  other_.reset();
  return Order::kFollowed;
}

void SourceClock::restartAt(double time, double wall_time) {
  newest_ = {time - 0.5 * kLargestGap, wall_time};
  other_.reset();
}

}  // namespace whirl_twin
