// Timing of a fixed-rate loop with any wake-up latency of the machine: counts and phases, no
// latencies.
#include "realtime/fixed_rate_loop.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "allocation_guard.h"
#include "loop_trial.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace fixed_rate_loop_test {

// Recorded data of the cycles of one run.
struct Trace {
  std::vector<std::int64_t> scheduled;
  std::vector<std::int64_t> woke;
  std::int64_t late_end = 0;  // when the cycle that overran ended
  LoopTiming timing;

  std::uint64_t skippedAfter(std::size_t cycle) const {
    return static_cast<std::uint64_t>((scheduled[cycle + 1] - scheduled[cycle]) / kPeriod - 1);
  }
  std::uint64_t skippedInAll() const {
    std::uint64_t skipped = 0;
    for (std::size_t i = 0; i + 1 < scheduled.size(); ++i) {
      skipped += skippedAfter(i);
    }
    return skipped;
  }
};

// Runs `cycles` cycles, of which number `late` takes until `lateness` [ns] after it was due.
Trace trace(const FixedRateLoop::Options& options, std::size_t cycles, std::size_t late,
            std::int64_t lateness) {
  Trace seen;
  seen.scheduled.reserve(cycles);
  seen.woke.reserve(cycles);
  FixedRateLoop loop(options);
  loop.start([&](std::int64_t scheduled) {
    seen.woke.push_back(monotonicNow());
    seen.scheduled.push_back(scheduled);
    if (seen.scheduled.size() == late + 1) {
      busyUntil(scheduled + lateness);
      seen.late_end = monotonicNow();
    }
    return seen.scheduled.size() < cycles;
  });
  waitForEnd(loop);
  loop.stop();
  seen.timing = loop.timing();
  return seen;
}

TEST(FixedRateLoop, EndsWhenTheCycleSaysSoAndCountsItsCycles) {
  const Trace seen = trace(ordinary(), 20, 0, 0);
  EXPECT_EQ(seen.scheduled.size(), 20U);
  EXPECT_EQ(seen.timing.cycles, 20U);
  EXPECT_EQ(seen.timing.wake_up_latency.count(), 20U);
  EXPECT_EQ(seen.timing.execution_time.count(), 20U);
  EXPECT_EQ(seen.timing.period.count(), 19U);
}

TEST(FixedRateLoop, WakesOnOneGridAndNeverEarly) {
  for (const auto policy : {OverrunPolicy::kSkip, OverrunPolicy::kCatchUp}) {
    for (const std::int64_t busy_wait : {std::int64_t{0}, std::int64_t{1}, kPeriod / 2}) {
      FixedRateLoop::Options options = ordinary(policy);
      options.busy_wait = busy_wait;
      const Trace seen = trace(options, 50, 25, 2 * kPeriod);
      ASSERT_EQ(seen.scheduled.size(), 50U);
      for (std::size_t i = 0; i < seen.scheduled.size(); ++i) {
        EXPECT_EQ((seen.scheduled[i] - seen.scheduled[0]) % kPeriod, 0);
        EXPECT_GE(seen.woke[i], seen.scheduled[i]);
      }
    }
  }
}

TEST(FixedRateLoop, SkipLeavesOutWhatWasMissedAndKeepsThePhase) {
  const Trace seen =
      trace(ordinary(), 10, 4, 7 * kPeriod / 2);  // ends 3.5 periods after it was due
  EXPECT_GE(seen.scheduled[5], seen.late_end);
  EXPECT_GE(seen.skippedAfter(4), 3U);
  EXPECT_GE(seen.timing.overruns, 1U);
  EXPECT_EQ(seen.timing.skipped, seen.skippedInAll());
}

TEST(FixedRateLoop, NothingIsLeftOutAfterTheLastCycle) {
  const Trace seen = trace(ordinary(), 5, 4, 7 * kPeriod / 2);
  EXPECT_GE(seen.timing.overruns, 1U);
  EXPECT_EQ(seen.timing.skipped, seen.skippedInAll());
}

TEST(FixedRateLoop, CatchUpRunsEveryMissedCycle) {
  FixedRateLoop::Options options = ordinary(OverrunPolicy::kCatchUp);
  options.max_catch_up = 1'000'000;  // more than any delay of the machine
  const Trace seen = trace(options, 15, 4, 7 * kPeriod / 2);
  for (std::size_t i = 0; i + 1 < seen.scheduled.size(); ++i) {
    EXPECT_EQ(seen.scheduled[i + 1] - seen.scheduled[i], kPeriod);
  }
  EXPECT_EQ(seen.timing.skipped, 0U);
  EXPECT_GE(seen.timing.overruns, 1U);
}

TEST(FixedRateLoop, CatchUpIsBounded) {
  FixedRateLoop::Options options = ordinary(OverrunPolicy::kCatchUp);
  options.max_catch_up = 2;
  const Trace seen = trace(options, 15, 4, 13 * kPeriod / 2);  // misses at least 6 cycles
  EXPECT_GE(seen.skippedAfter(4), 4U);
  EXPECT_LE(seen.late_end - seen.scheduled[5], 2 * kPeriod);
}

TEST(FixedRateLoop, StopEndsTheLoopAtTheFirstOverrun) {
  const Trace seen = trace(ordinary(OverrunPolicy::kStop), 1000, 4, 2 * kPeriod);
  EXPECT_EQ(seen.timing.overruns, 1U);
  EXPECT_EQ(seen.timing.skipped, 0U);
  EXPECT_LE(seen.scheduled.size(), 5U);  // earlier, if the machine itself was late
}

TEST(FixedRateLoop, GivesUpWhenItIsLateForTooLong) {
  FixedRateLoop::Options options = ordinary();
  options.give_up = 20 * kPeriod;
  FixedRateLoop loop(options);
  int cycles = 0;
  loop.start([&](std::int64_t scheduled) {
    // Late for half as long, once in time, then late for good.
    busyUntil(scheduled + (cycles == 5 ? 0 : 2 * kPeriod));
    return ++cycles < 1000;
  });
  waitForEnd(loop);
  EXPECT_TRUE(loop.gaveUp());
  EXPECT_GE(cycles, 6);
  EXPECT_LT(cycles, 100);
  FixedRateLoop patient(ordinary());
  cycles = 0;
  patient.start([&](std::int64_t scheduled) {
    busyUntil(scheduled + 2 * kPeriod);
    return ++cycles < 30;
  });
  waitForEnd(patient);
  EXPECT_FALSE(patient.gaveUp());
  EXPECT_EQ(cycles, 30);
}

// A cycle that ran too long had no wake-up latency; the one that catches up after it had.
TEST(FixedRateLoop, TellsLateWakeUpsFromLongCycles) {
  FixedRateLoop::Options options = ordinary(OverrunPolicy::kCatchUp);
  options.max_catch_up = 1'000'000;
  const Trace seen = trace(options, 40, 4, 20 * kPeriod);
  EXPECT_GE(seen.timing.late_wake_ups, 10U);
  EXPECT_LT(seen.timing.late_wake_ups, seen.timing.overruns);
}

TEST(FixedRateLoop, KeepsToAProcessor) {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  ASSERT_EQ(sched_getaffinity(0, sizeof(allowed), &allowed), 0);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(static_cast<std::size_t>(cpu), &allowed)) {
      continue;
    }
    FixedRateLoop::Options options = ordinary();
    options.cpu = cpu;
    FixedRateLoop loop(options);
    int seen = 0, cycles = 0;
    loop.start([&](std::int64_t) {
      seen += sched_getcpu() == cpu ? 1 : 0;
      return ++cycles < 20;
    });
    EXPECT_EQ(loop.status().cpu, cpu);
    waitForEnd(loop);
    EXPECT_EQ(seen, 20);
  }
}

TEST(FixedRateLoop, SaysWhenThereIsNoSuchProcessor) {
  FixedRateLoop::Options options = ordinary();
  options.cpu = CPU_SETSIZE - 1;
  options.mode = RealtimeMode::kWarn;
  FixedRateLoop loop(options);
  loop.start([](std::int64_t) { return false; });
  const std::vector<std::string> warnings = loop.status().warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("not pinned to processor") != std::string::npos;
  }));
  waitForEnd(loop);
  options.cpu = -2;
  EXPECT_THROW(FixedRateLoop{options}, InputError);
}

TEST(FixedRateLoop, DoesNotWaitAwakeForMoreThanHalfThePeriod) {
  FixedRateLoop::Options options = ordinary();
  options.busy_wait = kPeriod / 2 + 1;
  EXPECT_THROW(FixedRateLoop{options}, InputError);
  options.busy_wait = -1;
  EXPECT_THROW(FixedRateLoop{options}, InputError);
}

TEST(FixedRateLoop, WarmUpIsLeftOutOfTheHistogramsOnly) {
  FixedRateLoop::Options options = ordinary();
  options.warm_up_cycles = 5;
  const Trace seen = trace(options, 20, 1, 3 * kPeriod);  // the overrun is in the warm-up
  EXPECT_EQ(seen.timing.cycles, 20U);
  EXPECT_EQ(seen.timing.wake_up_latency.count(), 15U);
  EXPECT_EQ(seen.timing.execution_time.count(), 15U);
  EXPECT_EQ(seen.timing.period.count(), 15U);
  EXPECT_GE(seen.timing.overruns, 1U);
}

TEST(FixedRateLoop, TheThreeTimesAreMeasuredApart) {
  FixedRateLoop::Options options = ordinary(OverrunPolicy::kCatchUp);
  options.max_catch_up = 1'000'000;
  const Trace seen = trace(options, 10, 4, 4 * kPeriod);
  // The loop's times enclose those of the cycle: cycle 4 woke no later than woke[4], and cycle 5
  // woke no earlier than late_end, itself late by the overrun of cycle 4.
  EXPECT_GE(seen.timing.execution_time.max(), seen.late_end - seen.woke[4]);
  EXPECT_GE(seen.timing.period.max(), seen.late_end - seen.woke[4]);
  EXPECT_GE(seen.timing.wake_up_latency.max(), seen.late_end - seen.scheduled[5]);
  // The other cycles do nothing: at least one of them is shorter than the deliberately long one.
  EXPECT_LT(seen.timing.execution_time.min(), seen.timing.execution_time.max());
}

TEST(FixedRateLoop, ResetForgetsTheCyclesBefore) {
  FixedRateLoop loop(ordinary());
  int cycles = 0;
  loop.start([&](std::int64_t) {
    if (++cycles == 20) {
      loop.resetTiming();
    }
    return cycles < 30;
  });
  waitForEnd(loop);
  EXPECT_EQ(loop.timing().cycles, 10U);
  EXPECT_EQ(loop.timing().wake_up_latency.count(), 10U);
  EXPECT_EQ(loop.timing().period.count(), 10U);
  loop.resetTiming();  // at rest: at once
  EXPECT_EQ(loop.timing().cycles, 0U);
}

TEST(FixedRateLoop, StatisticsReadWhileItRunsAreWhole) {
  FixedRateLoop::Options options = ordinary();
  options.period = 50'000;
  FixedRateLoop loop(options);
  loop.start([](std::int64_t) { return true; });
  std::uint64_t before = 0;
  while (before < 2000) {
    const LoopTiming timing = loop.timing();
    ASSERT_GE(timing.cycles, before);
    ASSERT_EQ(timing.wake_up_latency.count(), timing.cycles);
    ASSERT_EQ(timing.execution_time.count(), timing.cycles);
    ASSERT_EQ(timing.period.count(), timing.cycles == 0 ? 0 : timing.cycles - 1);
    // The whole of a histogram is in its buckets: the last rank is found, at the longest sample.
    ASSERT_EQ(timing.period.percentile(100.0), timing.period.max());
    before = timing.cycles;
  }
  loop.stop();
}

TEST(FixedRateLoop, DoesNotAllocateWhileItRuns) {
  std::optional<AllocationGuard> guard;
  std::uint64_t allocations = 0;
  int cycles = 0;
  FixedRateLoop loop(ordinary());
  loop.start([&](std::int64_t scheduled) {
    if (cycles == 0) {
      guard.emplace();  // from here on also the loop between the cycles, in its thread
    }
    if (cycles == 10) {
      busyUntil(scheduled + 2 * kPeriod);
    }
    if (cycles == 20) {
      loop.resetTiming();
    }
    allocations = guard->allocations();
    return ++cycles < 30;
  });
  waitForEnd(loop);
  EXPECT_EQ(cycles, 30);
  EXPECT_EQ(allocations, 0U);
}

TEST(FixedRateLoop, ASignalDoesNotWakeItEarly) {
  struct sigaction ignore {};
  struct sigaction before {};
  ignore.sa_handler = [](int) {};  // without SA_RESTART
  sigaction(SIGUSR1, &ignore, &before);

  std::atomic<int> cycles{0};
  std::atomic<bool> early{false};
  pthread_t loop_thread{};
  FixedRateLoop::Options options = ordinary();
  options.period = 20'000'000;
  FixedRateLoop loop(options);
  loop.start([&](std::int64_t scheduled) {
    if (cycles == 0) {
      loop_thread = pthread_self();
    }
    early = early || monotonicNow() < scheduled;
    ++cycles;
    return true;
  });
  while (cycles < 1) {
    std::this_thread::yield();
  }
  while (cycles < 4) {
    pthread_kill(loop_thread, SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  loop.stop();
  sigaction(SIGUSR1, &before, nullptr);
  EXPECT_FALSE(early);
}

}  // namespace fixed_rate_loop_test
}  // namespace whirl_twin
