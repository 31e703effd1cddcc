#include "monitoring/reset_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "monitoring/source_clock.h"

namespace whirl_twin {
namespace {

/// [s], wall time: statistics come once a second, and some may be lost. A simulation that is silent
/// longer has ended.
constexpr double kSilence = 2.5;
/// [s], wall time that a rival counts after it was heard.
constexpr double kMemory = 5.0;
constexpr std::size_t kMostRivals = 16;
/// A simulation that ends while the next one begins returns once.
constexpr int kTurns = 2;
/// [s], simulated: clocks that are further apart are told apart by SourceClock.
constexpr double kNear = 2.0;
constexpr std::int64_t kStampSlack = 2'000'000'000;  // ns
/// A latched message, or one that was late, is no log.
constexpr int kFew = 20;

}  // namespace

bool ResetWatch::isOfPresent(const state::LoopStatistics& loop) const {
  return !present_ || present_->simulation == Simulation(loop.started, loop.sender);
}

bool ResetWatch::take(const state::LoopStatistics& loop, double wall_time) {
  if (loop.started == 0 && !present_) {  // it does not tell
    return false;
  }
  const Announcement said{
      {loop.started, loop.sender}, loop.epoch, loop.at.time, loop.at.stamp, wall_time};
  if (!present_) {
    present_ = said;
  }
  if (said.simulation != present_->simulation) {
    takeOfRival(said);
    return wall_time - heard_at_ > kSilence && announce(said);
  }
  returns_ += rival_was_last_ ? 1 : 0;
  rival_was_last_ = false;
  heard_at_ = wall_time;
  heard_time_ = said.time;
  heard_stamp_ = said.stamp;
  if (said.epoch <= present_->epoch) {
    if (said.epoch == present_->epoch) {
      next_.reset();
    }
    return false;
  }
  return announce(said);
}

bool ResetWatch::announce(const Announcement& said) {
  const bool again = next_ && next_->isSameRun(said) && next_->stamp != said.stamp;
  next_ = said;
  return again;
}

void ResetWatch::takeOfRival(const Announcement& said) {
  ++of_others_;
  for (auto one = rivals_.begin(); one != rivals_.end();) {
    one = said.wall_time - one->second.wall_time > kMemory ? rivals_.erase(one) : std::next(one);
  }
  returns_ = rivals_.empty() ? 0 : returns_;
  if (rivals_.size() < kMostRivals || rivals_.count(said.simulation) > 0) {
    rivals_[said.simulation] = {said.time, said.wall_time};
  }
  rival_was_last_ = true;
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
  if (next_) {
    rivals_.erase(next_->simulation);
    heard_at_ = next_->wall_time;
    heard_time_ = next_->time;
    heard_stamp_ = next_->stamp;
  }
  returns_ = 0;
  rival_was_last_ = wall_stamps_ = false;
  present_ = next_;
  next_.reset();
}

bool ResetWatch::hasRival(double wall_time) const {
  return playsEarlier(wall_time) ||
         std::any_of(rivals_.begin(), rivals_.end(), [&](const auto& rival) {
           return wall_time - rival.second.wall_time <= kMemory;
         });
}

bool ResetWatch::isOfEarlier(std::int64_t stamp) const {
  // A wall clock that was set back to before the start tells nothing.
  return wall_stamps_ && present_ && heard_stamp_ >= present_->simulation.first &&
         stamp < present_->simulation.first - kStampSlack;
}

bool ResetWatch::takeStamp(std::int64_t stamp, double wall_time) {
  wall_stamps_ = wall_stamps_ || (present_ && stamp >= present_->simulation.first);
  if (!isOfEarlier(stamp)) {
    return false;
  }
  earlier_ = wall_time - earlier_at_ > kMemory ? 1 : std::min(earlier_ + 1, kFew);
  earlier_at_ = wall_time;
  ++of_others_;
  return true;
}

bool ResetWatch::isOfRival(double time, double wall_time) const {
  const double own = std::fabs(time - heard_time_ - (wall_time - heard_at_));
  return std::any_of(rivals_.begin(), rivals_.end(), [&](const auto& rival) {
    const double since = wall_time - rival.second.wall_time;
    return since <= kMemory && std::fabs(time - rival.second.time - since) < own;
  });
}

bool ResetWatch::isAmbiguous(double wall_time) const {
  return std::any_of(rivals_.begin(), rivals_.end(), [&](const auto& rival) {
    const double apart = (rival.second.time - heard_time_) - (rival.second.wall_time - heard_at_);
    return wall_time - rival.second.wall_time <= kMemory && std::fabs(apart) < kNear;
  });
}

bool ResetWatch::playsEarlier(double wall_time) const {
  return earlier_ >= kFew && wall_time - earlier_at_ <= kMemory;
}

std::string ResetWatch::duplicate(double wall_time) const {
  if (playsEarlier(wall_time)) {
    return fmt::format(
        "states of an earlier run are received beside those of {}, from a log being played",
        sender());
  }
  if (returns_ < kTurns || !hasRival(wall_time)) {
    return "";
  }
  std::string names;
  for (const auto& [simulation, rival] : rivals_) {
    names += (names.empty() ? "" : " and ") +
             (simulation.second.empty() ? "a publisher without a name" : simulation.second);
  }
  return fmt::format("duplicate publisher: {} publishes as this twin beside {}", names, sender());
}

}  // namespace whirl_twin
