#include "monitoring/reset_watch.h"

#include "monitoring/source_clock.h"

namespace whirl_twin {

bool ResetWatch::take(const state::LoopStatistics& loop, double wall_time) {
  const Announcement said{loop.started, loop.epoch, loop.at.time, loop.at.stamp, wall_time};
  if (loop.started == 0) {  // it does not tell
    return false;
  }
  if (!present_) {
    present_ = said;
    return false;
  }
  if (said.run() <= present_->run()) {
    if (said.run() == present_->run()) {
      next_.reset();
    }
    return false;
  }
  const bool again = next_ && next_->run() == said.run() && next_->stamp != said.stamp;
  next_ = said;
  return again;
}

bool ResetWatch::confirmedBy(double time, double wall_time) const {
  if (!next_) {
    return false;
  }
  SourceClock clock;
  clock.restartAt(next_->time, next_->wall_time);
  return clock.take(time, wall_time) == SourceClock::Order::kInStep;
}

void ResetWatch::begin() {
  present_ = next_;
  next_.reset();
}

}  // namespace whirl_twin
