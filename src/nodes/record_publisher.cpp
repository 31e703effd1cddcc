#include "nodes/record_publisher.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "messages/wall_clock.h"
#include "nodes/duplicate_publishers.h"
#include "nodes/loop_report.h"
#include "realtime/monotonic_clock.h"
#include "transport/master_watch.h"

namespace whirl_twin {

namespace {

constexpr auto kClockPausePeriod = std::chrono::milliseconds(100);
constexpr auto kLoopReportPeriod = std::chrono::seconds(1);
constexpr auto kAgainPeriod = std::chrono::seconds(10);
constexpr auto kScenePeriod = std::chrono::seconds(2);  // shorter than the wait of a monitor
constexpr auto kMaxSaving = std::chrono::seconds(1);
constexpr std::chrono::microseconds kIdle{500};    // between polls of the ring
constexpr std::chrono::microseconds kMinIdle{25};  // in lockstep
constexpr int kMaxRecordsAtOnce = 64;              // records, between periodic tasks
constexpr std::int64_t kClockStep = 100'000'000;   // [ns]: larger changes are not slewing

std::int64_t wallClockAtZero() {
  return wallClock() - monotonicNow();
}

}  // namespace

RecordPublisher::RecordPublisher(LiveTwin& live, const FixedRateLoop& loop, StatePublisher states,
                                 LockstepListeners& lockstep, state::SceneText scene,
                                 std::int64_t every, std::chrono::microseconds batch, bool clock,
                                 bool measure)
    : live_(live),
      loop_(loop),
      observer_(live.twin(), live.generations()),
      orders_(live.twin()),
      states_(std::move(states)),
      lockstep_(lockstep),
      scene_(std::move(scene)),
      newest_step_(live.stepCount()),
      clock_(clock),
      every_(every),
      batch_(batch),
      thinning_(live.ringCapacity()),
      started_(wallClock()),
      clock_zero_(wallClockAtZero()),
      stopped_(live.twin().systems().size()),
      inaccurate_(live.twin().systems().size()),
      measuring_(measure) {
  if (!states_.lcm().warning().empty()) {
    ROS_WARN("%s", states_.lcm().warning().c_str());
  }
  if (measuring_) {
    for (const SensorSpec& sensor : live.twin().scene().sensors) {
      states_.advertise<state::Measurement>(sensor.name);
    }
    remeasure();
  }
}

RecordPublisher::~RecordPublisher() {
  join();
}

void RecordPublisher::start() {
  thread_ = std::thread([this] { run(); });
}

void RecordPublisher::join() {
  ending_.store(true);
  if (thread_.joinable()) {
    thread_.join();
  }
}

state::LoopStatistics RecordPublisher::report() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return report_;
}

void RecordPublisher::run() {
  touchMemory();
  std::vector<double> record(live_.twin().layout().size);
  auto next_clock = std::chrono::steady_clock::now();
  auto next_report = next_clock + kLoopReportPeriod;
  auto next_again = next_clock + kAgainPeriod;
  auto next_scene = next_clock + kScenePeriod;
  scene_.at.stamp = stampNow();
  states_.tell(scene_);
  publishReport();  // identifies the run before its first state
  std::chrono::microseconds idle = kIdle;
  while (true) {
    const bool last_round = ending_.load();
    bool stopped_now = false;
    int taken = 0;
    while ((taken < kMaxRecordsAtOnce || last_round) && live_.pop(record.data())) {
      stopped_now = take(record.data()) || stopped_now;
      thinning_.consumed(live_.waiting());
      ++taken;
    }
    states_.send();
    if (taken > 0) {  // after all records, which must not wait for the statistics
      states_.publishEnsembles(observer_);
      states_.send();
    }
    if (reset_requested_.exchange(false)) {
      forgetCounts();
    }
    const auto now = std::chrono::steady_clock::now();
    if (stopped_now || now >= next_report) {
      followWallClock();
      publishReport();
      next_report = now + kLoopReportPeriod;
    }
    if (now >= next_scene) {
      states_.tellAgain(scene_);
      next_scene = now + kScenePeriod;
    }
    if (taken > 0 || !live_.paused()) {
      next_again = now + kAgainPeriod;
    } else if (now >= next_again) {  // otherwise published between the states
      states_.republishParameters();
      next_again = now + kAgainPeriod;
    }
    if (clock_ && live_.paused() && now >= next_clock) {
      states_.publishClock(observer_);
      next_clock = now + kClockPausePeriod;
    }
    if (last_round) {
      return;
    }
    if (taken < kMaxRecordsAtOnce) {
      idle = lockstep_.on() ? std::min(taken > 0 ? kMinIdle : 2 * idle, kIdle)
                            : std::max(kIdle, batch_);
      std::this_thread::sleep_for(idle);
    }
  }
}

std::optional<SavedObserver> RecordPublisher::savedAt(std::int64_t step) {
  std::unique_lock<std::mutex> lock(saved_mutex_);
  const bool came = saved_anew_.wait_for(
      lock, kMaxSaving, [&] { return newest_saved_ && newest_saved_->step == step; });
  return came ? std::exchange(newest_saved_, std::nullopt) : std::nullopt;
}

SavedObserver RecordPublisher::savedAtEnd() {
  return saved(live_.stepCount());
}

SavedObserver RecordPublisher::saved(std::int64_t step) {
  return {step, imageOf(observer_), clock_steps_};
}

void RecordPublisher::restore(const Checkpoint& checkpoint, const std::string& source) {
  whirl_twin::restore(checkpoint, observer_, source);
  clock_steps_ = checkpoint.live["clock_steps"].as<std::int64_t>(0);
}

/// Handles one record; true if a system has just stopped. So does tell().
bool RecordPublisher::take(const double* record) {
  const std::int64_t step = RecordLayout::step(record);
  if (RecordLayout::scheduled(record) == RecordLayout::kSaved) {
    const std::lock_guard<std::mutex> lock(saved_mutex_);
    newest_saved_ = saved(step);
    saved_anew_.notify_all();
    return false;
  }
  const bool restarted = step < newest_step_;
  newest_step_ = step;
  return tell(record, restarted);
}

bool RecordPublisher::tell(const double* record, bool restarted) {
  const std::int64_t step = RecordLayout::step(record);
  const bool due = step % every_ == 0;
  const bool shown = due && step / every_ % thinning_.every() == 0;
  left_out_ += due && !shown ? 1 : 0;
  const bool orders_due = orders_.dueAt(step);
  if (!shown && !orders_due && !measuring_ && observer_.look(record)) {
    orders_.take(record, observer_);
    return false;
  }
  if (restarted) {
    clock_steps_ += observer_.step() + 1;
  }
  observer_.observe(record);
  orders_.take(record, observer_);
  stamp(record);
  if (restarted) {
    states_.send();
    publishReport();  // the new epoch precedes its states
  }
  if (shown) {
    lockstep_.published(step, restarted);  // first: an acknowledgement may arrive at once
  }
  states_.publish(observer_, shown && !observer_.tellsOnlyChange());
  if (measuring_) {
    measure(restarted);
  }
  if (orders_due && !observer_.tellsOnlyChange()) {
    states_.publishOrders(observer_, orders_);
  }
  bool stopped_now = false;
  for (std::size_t i = 0; i < stopped_.size(); ++i) {
    const bool stopped = observer_.status(i) != StepStatus::kOk;
    if (stopped && !stopped_[i]) {
      ROS_ERROR("%s", observer_.stopReason(i).c_str());
      stopped_now = true;
    }
    stopped_[i] = stopped;
  }
  return stopped_now;
}

/// /clock continues across a reset: its subscribers require a clock that does not run backward.
void RecordPublisher::stamp(const double* record) {
  const Scene& scene = live_.twin().scene();
  observer_.setStamp(clock_ ? scene.time + (clock_steps_ + RecordLayout::step(record)) * scene.step
                            : clock_zero_ + RecordLayout::scheduled(record));
}

/// Publishes the blocks of measurements of the scene's sensors that are complete.
void RecordPublisher::measure(bool reset) {
  if (reset) {
    return remeasure();
  }
  for (state::Measurement& block : measurements_->observe(observer_)) {
    block.at.stamp = observer_.instant().stamp;
    states_.tell(block);
  }
}

void RecordPublisher::remeasure() {
  measurements_.emplace(live_.twin().scene().sensors, live_.twin().built(), observer_);
}

void RecordPublisher::publishReport() {
  state::LoopStatistics report = loopStatistics(live_.twin(), observer_, loop_.status(),
                                                loop_.timing(), live_.paused(), dropped());
  report.at.stamp = stampNow();
  report.started = started_;
  report.sender = nameOfThisProcess();
  report.epoch = live_.resets();
  report.lcm_failed = lcmFailed();
  report.ros_lost = rosLost();
  report.publish_every = static_cast<std::uint64_t>(every_ * thinning_.every());
  report.real_time_factor = live_.pace();
  report.achieved_factor = achievedFactor(report);
  report.waits_for = lockstep_.waitsFor();
  addStepTimes(live_, report);
  if (report.lcm_failed > lcm_failed_told_) {
    ROS_WARN("%lu messages could not be sent on LCM, %lu in all: check the multicast route",
             static_cast<unsigned long>(report.lcm_failed - lcm_failed_told_),
             static_cast<unsigned long>(report.lcm_failed));
  }
  lcm_failed_told_ = report.lcm_failed;
  if (report.ros_lost > ros_lost_told_) {
    const std::string& topic = states_.ros().lostLast();
    ROS_WARN_THROTTLE(10.0, "a subscriber of %s is too slow: %lu messages lost; subscribers: %s",
                      topic.c_str(), static_cast<unsigned long>(report.ros_lost),
                      fmt::format("{}", fmt::join(listenersOf(topic), ", ")).c_str());
  }
  ros_lost_told_ = report.ros_lost;
  states_.tell(report);
  for (std::size_t i = 0; i < inaccurate_.size(); ++i) {
    const bool lost = report.error_estimate[i] > report.tolerance[i];
    if (lost && !inaccurate_[i]) {
      ROS_WARN("%s: error about %.1g over the horizon, above the tolerance %g (ACCURACY_LOST)",
               report.system[i].c_str(), report.error_estimate[i], report.tolerance[i]);
    }
    inaccurate_[i] = lost;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  report_ = report;
}

/// Since the previous report; NaN for the first one, or after a reset.
double RecordPublisher::achievedFactor(const state::LoopStatistics& report) {
  const double at = static_cast<double>(monotonicNow()) * 1.0e-9;
  const double factor = report.epoch == reported_epoch_
                            ? (report.at.time - reported_time_) / (at - reported_at_)
                            : std::numeric_limits<double>::quiet_NaN();
  reported_epoch_ = report.epoch;
  reported_time_ = report.at.time;
  reported_at_ = at;
  return factor;
}

/// Stamps follow the wall clock when it is set.
void RecordPublisher::followWallClock() {
  const std::int64_t zero = wallClockAtZero();
  if (!clock_ && std::abs(zero - clock_zero_) > kClockStep) {
    ROS_WARN("the wall clock was set by %+.3f s; stamps follow it",
             static_cast<double>(zero - clock_zero_) * 1.0e-9);
  }
  clock_zero_ = zero;
}

void RecordPublisher::forgetCounts() {
  dropped_before_ = live_.dropped() + left_out_;
  lcm_failed_before_ = states_.lcm().failed();
  lcm_failed_told_ = 0;
  ros_lost_before_ = states_.ros().lost();
  ros_lost_told_ = 0;
}

}  // namespace whirl_twin
