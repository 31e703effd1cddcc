// Start and end of a fixed-rate loop, and its report of the scheduling rights obtained.
#include <gtest/gtest.h>

#include <atomic>
#include <cfloat>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "loop_trial.h"
#include "messages/input_error.h"
#include "realtime/denormals.h"
#include "realtime/fixed_rate_loop.h"
#include "without_privileges.h"

namespace whirl_twin {
namespace fixed_rate_loop_control_test {

TEST(FixedRateLoopControl, CanBeStoppedFromAnotherThread) {
  std::atomic<int> cycles{0};
  FixedRateLoop loop(ordinary());
  EXPECT_FALSE(loop.running());
  loop.start([&cycles](std::int64_t) { return ++cycles > 0; });
  EXPECT_TRUE(loop.running());
  while (cycles < 5) {
    std::this_thread::yield();
  }
  std::thread([&loop] { loop.stop(); }).join();
  EXPECT_FALSE(loop.running());
  const int at_stop = cycles;
  EXPECT_EQ(loop.timing().cycles, static_cast<std::uint64_t>(at_stop));
  loop.stop();  // a second call is harmless
  EXPECT_EQ(cycles, at_stop);
}

TEST(FixedRateLoopControl, CanBeStoppedFromItsOwnCycle) {
  FixedRateLoop loop(ordinary());
  int cycles = 0;
  loop.start([&](std::int64_t) {
    if (++cycles == 3) {
      loop.stop();
    }
    return true;
  });
  waitForEnd(loop);
  loop.stop();
  EXPECT_EQ(cycles, 3);
}

// Two seconds are far more than the 50 ms it takes, and far less than the period.
TEST(FixedRateLoopControl, ALongPeriodDoesNotDelayTheStop) {
  FixedRateLoop::Options options = ordinary();
  options.period = 10'000'000'000;
  FixedRateLoop loop(options);
  loop.start([](std::int64_t) { return true; });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // so that it is asleep when stopped
  const std::int64_t before = monotonicNow();
  loop.stop();
  EXPECT_LT(monotonicNow() - before, 2'000'000'000);
  EXPECT_EQ(loop.timing().cycles, 0U);
}

TEST(FixedRateLoopControl, CanBeStartedAgainAndCountsAnew) {
  FixedRateLoop loop(ordinary());
  for (const int wanted : {5, 3}) {
    int cycles = 0;
    loop.start([&cycles, wanted](std::int64_t) { return ++cycles < wanted; });
    waitForEnd(loop);
    EXPECT_EQ(loop.timing().cycles, static_cast<std::uint64_t>(wanted));
  }
}

TEST(FixedRateLoopControl, IsNotStartedTwiceAtATime) {
  FixedRateLoop loop(ordinary());
  loop.start([](std::int64_t) { return true; });
  EXPECT_THROW(loop.start([](std::int64_t) { return true; }), std::logic_error);
  EXPECT_TRUE(loop.running());
}

TEST(FixedRateLoopControl, ItsThreadRoundsDenormalsToZero) {
  volatile double smallest = DBL_MIN;
  double half = 1.0;
  FixedRateLoop loop(ordinary());
  loop.start([&](std::int64_t) {
    half = smallest / 2.0;
    return false;
  });
  waitForEnd(loop);
  loop.stop();
  EXPECT_EQ(half == 0.0, DenormalsToZero::kSupported);
}

TEST(FixedRateLoopControl, ACycleThatThrowsEndsTheLoopWhichSaysSo) {
  FixedRateLoop loop(ordinary());
  loop.start([](std::int64_t) -> bool { throw std::runtime_error("broken shaft"); });
  waitForEnd(loop);
  ASSERT_EQ(loop.status().warnings.size(), 1U);
  EXPECT_EQ(loop.status().warnings[0], "the loop has ended: its cycle failed: broken shaft");
}

TEST(FixedRateLoopControl, WithoutPrivilegesIgnoreRunsAsAnyOtherThread) {
  const WithoutPrivileges user;
  FixedRateLoop loop(ordinary());
  loop.start([](std::int64_t) { return false; });
  const RealtimeStatus status = loop.status();
  EXPECT_EQ(status.policy, "SCHED_OTHER");
  EXPECT_EQ(status.priority, 0);
  EXPECT_FALSE(status.memory_locked);
  EXPECT_EQ(status.kernel, kernelDescription());
  EXPECT_TRUE(status.warnings.empty());
}

TEST(FixedRateLoopControl, WithoutPrivilegesEnforceDoesNotStart) {
  const WithoutPrivileges user;
  FixedRateLoop::Options options = ordinary();
  options.mode = RealtimeMode::kEnforce;
  FixedRateLoop loop(options);
  bool ran = false;
  EXPECT_THROW(loop.start([&ran](std::int64_t) { return ran = true; }), std::runtime_error);
  EXPECT_FALSE(loop.running());
  loop.stop();
  EXPECT_FALSE(ran);
}

TEST(FixedRateLoopControl, WithoutPrivilegesWarnRunsAndSaysWhatIsMissing) {
  const WithoutPrivileges user;
  FixedRateLoop::Options options = ordinary();
  options.mode = RealtimeMode::kWarn;
  FixedRateLoop loop(options);
  loop.start([](std::int64_t) { return false; });
  const RealtimeStatus status = loop.status();
  EXPECT_EQ(status.policy, "SCHED_OTHER");
  EXPECT_GE(status.warnings.size(),
            2U);  // memory, scheduling; the processors' sleep may be a third
  waitForEnd(loop);
  EXPECT_EQ(loop.timing().cycles, 1U);
}

TEST(FixedRateLoopControl, AnOptionOutOfRangeIsNamed) {
  const auto message_of = [](FixedRateLoop::Options options) -> std::string {
    try {
      FixedRateLoop loop(options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  FixedRateLoop::Options options = ordinary();
  EXPECT_EQ(message_of(options), "accepted");
  options.period = 0;
  EXPECT_EQ(message_of(options),
            "fixed-rate loop: period: expected 10000 to 3600000000000 ns, found 0");
  options = ordinary();
  options.priority = 99;
  EXPECT_EQ(message_of(options), "fixed-rate loop: priority: expected 1 to 98, found 99");
  options = ordinary();
  options.stack_size = 1000;
  EXPECT_EQ(message_of(options),
            "fixed-rate loop: stack_size: expected at least 65536 bytes, found 1000");
  FixedRateLoop loop(ordinary());
  EXPECT_THROW(loop.start(nullptr), std::logic_error);
}

}  // namespace fixed_rate_loop_control_test
}  // namespace whirl_twin
