#include "monitoring/run_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <variant>

namespace whirl_twin {
namespace {

/// [s], simulated: lost states leave smaller gaps, if the source has not been silent.
constexpr double kMaxGap = 1.0;
/// A log may be played so many times faster than it was recorded, over a gap.
constexpr double kFastestPlay = 10.0;
/// [s], wall time: long beside what a network delays, short beside the delays of alarms.
constexpr double kFollowAfter = 0.5;
/// [s], wall time: statistics come once a second, and some may be lost. A simulation that is silent
/// longer has ended.
constexpr double kRunTimeout = 2.5;
/// [s], wall time that a duplicate publisher counts after it was received.
constexpr double kDuplicateMemory = 5.0;
constexpr std::size_t kMaxDuplicates = 16;
/// A simulation that ends while the next one starts returns once.
constexpr int kMinReturns = 2;
/// [s], simulated: clocks that are further apart are distinguished by SourceClock.
constexpr double kNearClocks = 2.0;
constexpr std::int64_t kStampSlack = 2'000'000'000;  // ns
/// A latched message, or one that was late, is no log.
constexpr int kMinEarlier = 20;

template <class State>
constexpr bool kHasOwnClock =
    State::kKind.has(MessageKind::kCommand) || std::is_same_v<State, state::Measurement> ||
    std::is_same_v<State, state::FollowState> || std::is_same_v<State, state::SceneText> ||
    std::is_same_v<State, state::ControllerMeasurement> ||
    std::is_same_v<State, state::ControllerCommand>;

}  // namespace

SourceClock::Order SourceClock::update(double time, double wall_time, double pace) {
  if (!newest_ || (time > newest_->time &&
                   time - newest_->time <=
                       pace * (kMaxGap + kFastestPlay * (wall_time - newest_->wall_time)))) {
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
  newest_ = {time - 0.5 * kMaxGap, wall_time};
  other_.reset();
}

bool RunTracker::isOfPresent(const state::LoopStatistics& loop) const {
  return !present_ || present_->simulation == Simulation(loop.started, loop.sender);
}

bool RunTracker::update(const state::LoopStatistics& loop, double wall_time) {
  if (loop.started == 0 && !present_) {  // it does not report
    return false;
  }
  const Announcement reported{
      {loop.started, loop.sender}, loop.epoch, loop.at.time, loop.at.stamp, wall_time};
  if (!present_) {
    present_ = reported;
  }
  if (reported.simulation != present_->simulation) {
    updateDuplicate(reported);
    return wall_time - received_at_ > kRunTimeout && announce(reported);
  }
  returns_ += duplicate_was_last_ ? 1 : 0;
  duplicate_was_last_ = false;
  received_at_ = wall_time;
  received_time_ = reported.time;
  received_stamp_ = reported.stamp;
  if (reported.epoch <= present_->epoch) {
    if (reported.epoch == present_->epoch) {
      next_.reset();
    }
    return false;
  }
  return announce(reported);
}

bool RunTracker::announce(const Announcement& reported) {
  const bool again = next_ && next_->isSameRun(reported) && next_->stamp != reported.stamp;
  next_ = reported;
  return again;
}

void RunTracker::updateDuplicate(const Announcement& reported) {
  ++of_others_;
  for (auto one = duplicates_.begin(); one != duplicates_.end();) {
    one = reported.wall_time - one->second.wall_time > kDuplicateMemory ? duplicates_.erase(one)
                                                                        : std::next(one);
  }
  returns_ = duplicates_.empty() ? 0 : returns_;
  if (duplicates_.size() < kMaxDuplicates || duplicates_.count(reported.simulation) > 0) {
    duplicates_[reported.simulation] = {reported.time, reported.wall_time};
  }
  duplicate_was_last_ = true;
}

bool RunTracker::confirmedBy(double time, double wall_time) const {
  if (!next_) {
    return false;
  }
  SourceClock clock;
  clock.restartAt(next_->time, next_->wall_time);
  return clock.update(time, wall_time) == SourceClock::Order::kInStep;
}

void RunTracker::restart() {
  if (next_) {
    duplicates_.erase(next_->simulation);
    received_at_ = next_->wall_time;
    received_time_ = next_->time;
    received_stamp_ = next_->stamp;
  }
  returns_ = 0;
  duplicate_was_last_ = wall_stamps_ = false;
  present_ = next_;
  next_.reset();
}

bool RunTracker::hasDuplicate(double wall_time) const {
  return playsEarlier(wall_time) ||
         std::any_of(duplicates_.begin(), duplicates_.end(), [&](const auto& other) {
           return wall_time - other.second.wall_time <= kDuplicateMemory;
         });
}

bool RunTracker::isOfEarlier(std::int64_t stamp) const {
  // A wall clock that was set back to before the start is no evidence.
  return wall_stamps_ && present_ && received_stamp_ >= present_->simulation.first &&
         stamp < present_->simulation.first - kStampSlack;
}

bool RunTracker::updateStamp(std::int64_t stamp, double wall_time) {
  wall_stamps_ = wall_stamps_ || (present_ && stamp >= present_->simulation.first);
  if (!isOfEarlier(stamp)) {
    return false;
  }
  earlier_ = wall_time - earlier_at_ > kDuplicateMemory ? 1 : std::min(earlier_ + 1, kMinEarlier);
  earlier_at_ = wall_time;
  ++of_others_;
  return true;
}

bool RunTracker::isOfDuplicate(double time, double wall_time) const {
  const double own = std::fabs(time - received_time_ - (wall_time - received_at_));
  return std::any_of(duplicates_.begin(), duplicates_.end(), [&](const auto& other) {
    const double since = wall_time - other.second.wall_time;
    return since <= kDuplicateMemory && std::fabs(time - other.second.time - since) < own;
  });
}

bool RunTracker::isAmbiguous(double wall_time) const {
  return std::any_of(duplicates_.begin(), duplicates_.end(), [&](const auto& other) {
    const double apart =
        (other.second.time - received_time_) - (other.second.wall_time - received_at_);
    return wall_time - other.second.wall_time <= kDuplicateMemory && std::fabs(apart) < kNearClocks;
  });
}

bool RunTracker::playsEarlier(double wall_time) const {
  return earlier_ >= kMinEarlier && wall_time - earlier_at_ <= kDuplicateMemory;
}

std::string RunTracker::duplicate(double wall_time) const {
  if (playsEarlier(wall_time)) {
    return fmt::format(
        "states of an earlier run are received beside those of {}, from a log being played",
        sender());
  }
  if (returns_ < kMinReturns || !hasDuplicate(wall_time)) {
    return "";
  }
  std::string names;
  for (const auto& [simulation, last] : duplicates_) {
    names += (names.empty() ? "" : " and ") +
             (simulation.second.empty() ? "a publisher without a name" : simulation.second);
  }
  return fmt::format("duplicate publisher: {} publishes as this twin beside {}", names, sender());
}

bool RunFilter::take(const Message& message, double wall_time) {
  return std::visit(
      [&](const auto& state) {
        using State = std::decay_t<decltype(state)>;
        if constexpr (std::is_same_v<State, state::LoopStatistics>) {
          return takeLoop(state, wall_time);
        } else if constexpr (kHasOwnClock<State>) {
          return true;
        } else if constexpr (std::is_same_v<State, state::Alert>) {
          return take(std::nullopt, state.time, wall_time);  // sent again without a stamp
        } else {
          return take(state.at.stamp, state.at.time, wall_time);
        }
      },
      message);
}

bool RunFilter::takeLoop(const state::LoopStatistics& loop, double wall_time) {
  if (run_.update(loop, wall_time)) {
    run_.restart();
  }
  const bool own = run_.isOfPresent(loop);
  of_others_ += own ? 0 : 1;
  return own;
}

bool RunFilter::take(std::optional<std::int64_t> stamp, double time, double wall_time) {
  if (run_.confirmedBy(time, wall_time)) {
    run_.restart();
  }
  const bool of_other = (stamp && run_.updateStamp(*stamp, wall_time)) ||
                        run_.isAmbiguous(wall_time) || run_.isOfDuplicate(time, wall_time);
  of_others_ += of_other ? 1 : 0;
  return !of_other;
}

void StateGate::restart(double time, double wall_time) {
  time_ = loop_time_ = time;
  for (auto& [source, clock] : clocks_) {
    clock.restartAt(time, wall_time);
  }
  loop_clock_.restartAt(time, wall_time);
  run_.restart();
  restarted_ = true;
}

bool StateGate::accept(const std::string& source, const state::Instant& at, double wall_time) {
  wall_time_ = wall_time;
  // Messages of sensors and estimators have the stamps of their machine.
  const bool of_twin = source.rfind("measured/", 0) != 0 && source.rfind("follow/", 0) != 0;
  if (of_twin && run_.updateStamp(at.stamp, wall_time)) {
    return false;
  }
  if (run_.isOfDuplicate(at.time, wall_time)) {
    if (!run_.confirmedBy(at.time, wall_time)) {
      return false;
    }
    restart(at.time, wall_time);
  }
  // Each source against itself: one may be seconds ahead of another when the monitor was held up.
  const auto [known, first] = clocks_.try_emplace(source);
  SourceClock& clock = known->second;
  SourceClock::Order order = clock.update(at.time, wall_time, pace_);
  if (order != SourceClock::Order::kInStep && run_.confirmedBy(at.time, wall_time)) {
    restart(at.time, wall_time);
    order = clock.update(at.time, wall_time, pace_);
  }
  if (order == SourceClock::Order::kOutOfStep) {
    return false;
  }
  const bool restarts = order == SourceClock::Order::kFollowed || (first && clocks_.size() == 1);
  if (restarts || at.time >= time_) {
    time_ = at.time;
    step_ = at.step;
  }
  return true;
}

StateGate::Result StateGate::accept(const state::LoopStatistics& loop, double wall_time) {
  wall_time_ = wall_time;
  const double time = loop.at.time;
  const bool had_duplicate = run_.hasDuplicate(wall_time);
  if (run_.update(loop, wall_time)) {
    restart(time, wall_time);
  }
  if (!run_.isOfPresent(loop)) {
    return had_duplicate ? Result::kRejected : Result::kNewDuplicate;
  }
  // In a pause time is constant, and the statistics continue.
  const double pace = std::fmax(1.0, std::fmax(loop.real_time_factor, loop.achieved_factor));
  if (time != loop_time_ &&
      loop_clock_.update(time, wall_time, pace) == SourceClock::Order::kOutOfStep) {
    return Result::kRejected;
  }
  pace_ = pace;
  loop_time_ = time;
  return Result::kAccepted;
}

std::string StateGate::uncertainty(double wall_time) const {
  if (!uncertain_.empty()) {
    return uncertain_;
  }
  return run_.isAmbiguous(wall_time)
             ? "two twins publish at the same simulated time and cannot be distinguished"
             : "";
}

}  // namespace whirl_twin
