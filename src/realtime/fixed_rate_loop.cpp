#include "realtime/fixed_rate_loop.h"

#include <fmt/format.h>
#include <sched.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <future>
#include <stdexcept>
#include <thread>
#include <utility>

#include "messages/input_error.h"
#include "realtime/denormals.h"
#include "realtime/monotonic_clock.h"

namespace whirl_twin {

std::string toString(OverrunPolicy policy) {
  switch (policy) {
    case OverrunPolicy::kSkip:
      return "skip";
    case OverrunPolicy::kCatchUp:
      return "catch_up";
    case OverrunPolicy::kStop:
      return "stop";
  }
  throw std::logic_error("overrun policy: not one of the enumeration");
}

OverrunPolicy parseOverrunPolicy(const std::string& name) {
  for (const OverrunPolicy policy :
       {OverrunPolicy::kSkip, OverrunPolicy::kCatchUp, OverrunPolicy::kStop}) {
    if (name == toString(policy)) {
      return policy;
    }
  }
  throw InputError("overrun policy: must be skip, catch_up or stop, found \"" + name + "\"");
}

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;       // [ns]
constexpr std::int64_t kMinPeriod = 10'000;           // [ns]
constexpr std::int64_t kMaxPeriod = 3'600 * kSecond;  // [ns]
constexpr std::uint64_t kPageFaultsEvery = 64;        // cycles
// [ns], bounds the reaction time of stop()
constexpr std::int64_t kMaxSleep = kSecond / 20;

// The loop whose cycle this thread is running, if any: stop() must not join its own thread.
thread_local const FixedRateLoop* own_loop = nullptr;

void check(bool in_range, const char* option, const std::string& expected, std::int64_t found) {
  if (!in_range) {
    throw InputError(
        fmt::format("fixed-rate loop: {}: expected {}, found {}", option, expected, found));
  }
}

}  // namespace

// Arguments that start() passes to the thread, which moves them into its own frame.
struct FixedRateLoop::Launch {
  FixedRateLoop* loop;
  RealtimeStatus status;
  std::promise<RealtimeStatus> ready;
};

FixedRateLoop::FixedRateLoop(const Options& options) : options_(options) {
  check(options.period >= kMinPeriod && options.period <= kMaxPeriod, "period",
        fmt::format("{} to {} ns", kMinPeriod, kMaxPeriod), options.period);
  check(options.priority >= 1 && options.priority <= 98, "priority", "1 to 98", options.priority);
  check(options.cpu >= -1 && options.cpu < CPU_SETSIZE, "cpu",
        fmt::format("-1 (any) to {}", CPU_SETSIZE - 1), options.cpu);
  check(options.give_up >= 0, "give_up", "0 (never) or more ns", options.give_up);
  check(options.busy_wait >= 0 && options.busy_wait <= options.period / 2, "busy_wait",
        "0 ns to half the period", options.busy_wait);
  check(options.stack_size >= 65'536, "stack_size", "at least 65536 bytes",
        static_cast<std::int64_t>(options.stack_size));
}

FixedRateLoop::~FixedRateLoop() {
  stop();
}

void FixedRateLoop::start(Cycle cycle) {
  if (!cycle) {
    throw std::logic_error("fixed-rate loop: expected a cycle function, found none");
  }
  const std::lock_guard<std::mutex> lock(control_mutex_);
  if (running()) {
    throw std::logic_error("fixed-rate loop: started while it is running");
  }
  join();
  cycle_ = std::move(cycle);
  failure_.clear();
  stop_requested_ = false;
  reset_requested_ = false;
  gave_up_ = false;
  page_faults_ = 0;
  clearTiming();
  warm_up_left_ = options_.warm_up_cycles;
  woke_before_ = 0;

  Launch launch{this, {}, {}};
  launch.status.kernel = kernelDescription();
  std::future<RealtimeStatus> ready = launch.ready.get_future();

  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  int error = pthread_attr_setstacksize(&attributes, options_.stack_size);
  if (error == 0) {
    running_ = true;
    error = pthread_create(&thread_, &attributes, &FixedRateLoop::enter, &launch);
  }
  pthread_attr_destroy(&attributes);
  if (error != 0) {
    running_ = false;
    throw RunFailure(fmt::format("fixed-rate loop: no thread with a stack of {} bytes: {}",
                                 options_.stack_size, std::strerror(error)));
  }
  joinable_ = true;
  try {
    status_ = ready.get();
  } catch (...) {
    join();
    throw;
  }
}

void FixedRateLoop::stop() noexcept {
  if (own_loop == this) {
    stop_requested_ = true;
    return;
  }
  const std::lock_guard<std::mutex> lock(control_mutex_);
  stop_requested_ = true;
  join();
}

void FixedRateLoop::join() noexcept {
  if (joinable_) {
    pthread_join(thread_, nullptr);
    joinable_ = false;
  }
}

RealtimeStatus FixedRateLoop::status() const {
  const std::lock_guard<std::mutex> lock(control_mutex_);
  RealtimeStatus status = status_;
  if (!running() && !failure_.empty()) {
    status.warnings.push_back("the loop has ended: its cycle failed: " + failure_);
  }
  return status;
}

void* FixedRateLoop::enter(void* launch) noexcept {
  FixedRateLoop& loop = *static_cast<Launch*>(launch)->loop;
  std::promise<RealtimeStatus> ready = std::move(static_cast<Launch*>(launch)->ready);
  RealtimeStatus status = std::move(static_cast<Launch*>(launch)->status);
  try {
    lockMemory(loop.options_.mode, status);  // here: with the stack of this thread
    keepThisThreadTo(loop.options_.cpu, loop.options_.mode, status);
    scheduleThisThread(loop.options_.mode, loop.options_.priority, status);
    const ProcessorAwake awake(loop.options_.mode, status);
    ready.set_value(std::move(status));
    own_loop = &loop;
    loop.run();
  } catch (...) {
    ready.set_exception(std::current_exception());
  }
  loop.running_.store(false, std::memory_order_release);
  return nullptr;
}

void FixedRateLoop::run() noexcept {
  const DenormalsToZero denormals_to_zero;
  std::int64_t scheduled = monotonicNow() + options_.period;
  std::int64_t in_time = scheduled;  // the last cycle that was
  try {
    while (sleepUntil(scheduled)) {
      const std::int64_t woke = monotonicNow();
      const bool go_on = cycle_(scheduled);
      const std::int64_t finished = monotonicNow();
      WakeUp next =
          nextWakeUp(options_.policy, scheduled, finished, options_.period, options_.max_catch_up);
      if (!go_on) {
        next.skipped = 0;  // no cycle follows, so none is skipped
      }
      record(scheduled, woke, finished, next);
      if (!next.overrun) {
        in_time = finished;
      } else if (options_.give_up > 0 && finished - in_time >= options_.give_up) {
        gave_up_.store(true, std::memory_order_release);
        return;
      }
      if (!go_on || next.stop) {
        return;
      }
      scheduled = next.next;
    }
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
  } catch (...) {
    failure_ = "an exception that is not a std::exception";
  }
}

// False when a stop of the loop was requested. Long sleeps are divided, with the same absolute end;
// the last part is a busy wait.
bool FixedRateLoop::sleepUntil(std::int64_t instant) noexcept {
  for (;;) {
    if (stop_requested_.load(std::memory_order_relaxed)) {
      return false;
    }
    if (reset_requested_.load(std::memory_order_relaxed)) {
      reset_requested_.store(false, std::memory_order_relaxed);
      clearTiming();
    }
    const std::int64_t now = monotonicNow();
    if (now >= instant) {
      return true;
    }
    const std::int64_t until = std::min(instant - options_.busy_wait, now + kMaxSleep);
    if (now >= until) {
      continue;
    }
    const timespec wake_up{static_cast<time_t>(until / kSecond), until % kSecond};
    // It returns EINTR (errno is not set) when a signal interrupts it: the loop then sleeps again.
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake_up, nullptr);
  }
}

// The statistics are a sequence lock: the count is odd while they change. All fields are atomic,
// stored with release and loaded with acquire, so a reader that sees a new value also sees a
// changed count.
void FixedRateLoop::record(std::int64_t scheduled, std::int64_t woke, std::int64_t finished,
                           const WakeUp& next) noexcept {
  const auto add = [](std::atomic<std::uint64_t>& count, std::uint64_t more) {
    count.store(count.load(std::memory_order_relaxed) + more, std::memory_order_release);
  };
  const std::uint64_t sequence = sequence_.load(std::memory_order_relaxed);
  sequence_.store(sequence + 1, std::memory_order_relaxed);
  if (warm_up_left_ > 0) {
    --warm_up_left_;
  } else {
    wake_up_latency_.add(woke - scheduled);
    execution_time_.add(finished - woke);
    if (woke_before_ != 0) {
      period_.add(woke - woke_before_);
    }
  }
  woke_before_ = woke;
  add(cycles_, 1);
  add(overruns_, next.overrun ? 1 : 0);
  add(late_wake_ups_, next.overrun && woke - scheduled > finished - woke ? 1 : 0);
  add(skipped_, next.skipped);
  // A system call: not in every cycle, which may be a few microseconds long.
  if (next.overrun || cycles_.load(std::memory_order_relaxed) % kPageFaultsEvery == 0) {
    page_faults_.store(threadPageFaults(), std::memory_order_release);
  }
  sequence_.store(sequence + 2, std::memory_order_release);
}

void FixedRateLoop::clearTiming() noexcept {
  const std::uint64_t sequence = sequence_.load(std::memory_order_relaxed);
  sequence_.store(sequence + 1, std::memory_order_relaxed);
  wake_up_latency_.reset();
  execution_time_.reset();
  period_.reset();
  for (std::atomic<std::uint64_t>* count : {&cycles_, &overruns_, &late_wake_ups_, &skipped_}) {
    count->store(0, std::memory_order_release);
  }
  sequence_.store(sequence + 2, std::memory_order_release);
}

LoopTiming FixedRateLoop::timing() const {
  LoopTiming timing;
  for (;;) {
    const std::uint64_t before = sequence_.load(std::memory_order_acquire);
    if (before % 2 == 0) {
      timing.wake_up_latency = wake_up_latency_;
      timing.execution_time = execution_time_;
      timing.period = period_;
      timing.cycles = cycles_.load(std::memory_order_acquire);
      timing.overruns = overruns_.load(std::memory_order_acquire);
      timing.late_wake_ups = late_wake_ups_.load(std::memory_order_acquire);
      timing.skipped = skipped_.load(std::memory_order_acquire);
      timing.page_faults = page_faults_.load(std::memory_order_acquire);
      if (sequence_.load(std::memory_order_relaxed) == before) {
        return timing;
      }
    }
    // The loop was writing, which takes well under a microsecond, once a period.
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  }
}

void FixedRateLoop::resetTiming() noexcept {
  if (own_loop == this || running()) {
    reset_requested_.store(true, std::memory_order_relaxed);
    return;
  }
  const std::lock_guard<std::mutex> lock(control_mutex_);
  if (!running()) {
    clearTiming();
  }
}

}  // namespace whirl_twin
