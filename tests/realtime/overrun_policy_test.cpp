#include <gtest/gtest.h>

#include <random>

#include "messages/input_error.h"
#include "realtime/fixed_rate_loop.h"

namespace whirl_twin {
namespace overrun_policy_test {

// The instants of these cases: due at 1000, every 100.
struct Case {
  OverrunPolicy policy;
  std::int64_t now;
  std::uint64_t max_catch_up;
  std::int64_t next;
  std::uint64_t skipped;
  bool overrun;
  bool stop;
};

TEST(OverrunPolicy, TableOfCases) {
  constexpr auto kSkip = OverrunPolicy::kSkip;
  constexpr auto kCatchUp = OverrunPolicy::kCatchUp;
  constexpr auto kStop = OverrunPolicy::kStop;
  const Case cases[] = {
      // in time: every policy continues one period later
      {kSkip, 1000, 3, 1100, 0, false, false},
      {kSkip, 1050, 3, 1100, 0, false, false},
      {kCatchUp, 1099, 3, 1100, 0, false, false},
      {kStop, 1050, 3, 1100, 0, false, false},
      // ended at the very instant the next is due: still in time
      {kSkip, 1100, 3, 1100, 0, false, false},
      {kStop, 1100, 3, 1100, 0, false, false},
      // a nanosecond late: the cycle due at 1100 has been missed
      {kSkip, 1101, 3, 1200, 1, true, false},
      {kCatchUp, 1101, 3, 1100, 0, true, false},
      {kStop, 1101, 3, 1100, 0, true, true},
      // several periods late
      {kSkip, 1350, 3, 1400, 3, true, false},
      {kSkip, 1400, 3, 1400, 3, true, false},
      {kSkip, 1401, 3, 1500, 4, true, false},
      {kCatchUp, 1350, 3, 1100, 0, true, false},
      {kStop, 1350, 3, 1100, 0, true, true},
      // more missed than may be caught up: the oldest are skipped
      {kCatchUp, 1350, 2, 1200, 1, true, false},
      {kCatchUp, 1401, 3, 1200, 1, true, false},
      {kCatchUp, 1350, 0, 1400, 3, true, false},
      // the clock reads earlier than the schedule (a test's clock may): in time
      {kSkip, 900, 3, 1100, 0, false, false},
  };
  for (const Case& given : cases) {
    const WakeUp found = nextWakeUp(given.policy, 1000, given.now, 100, given.max_catch_up);
    SCOPED_TRACE(toString(given.policy) + " at " + std::to_string(given.now) + ", bound " +
                 std::to_string(given.max_catch_up));
    EXPECT_EQ(found.next, given.next);
    EXPECT_EQ(found.skipped, given.skipped);
    EXPECT_EQ(found.overrun, given.overrun);
    EXPECT_EQ(found.stop, given.stop);
  }
}

TEST(OverrunPolicy, IsKnownToTheCompiler) {
  static_assert(nextWakeUp(OverrunPolicy::kSkip, 0, 250, 100, 0).next == 300);
}

class OverrunPolicyProperty : public ::testing::Test {
 protected:
  // Calls visit(policy, scheduled, now, period, bound, result) for many drawn situations, up to
  // 1000 periods late, from 10 us to 10 s, with clocks up to a year of uptime.
  template <class Visit>
  void forMany(OverrunPolicy policy, Visit visit) {
    std::mt19937_64 random(20240917);
    const auto draw = [&random](std::int64_t low, std::int64_t high) {
      return std::uniform_int_distribution<std::int64_t>(low, high)(random);
    };
    for (int i = 0; i < 20'000; ++i) {
      const std::int64_t period = draw(10'000, i % 2 == 0 ? 1'000'000 : 10'000'000'000);
      const std::int64_t scheduled = draw(0, 31'536'000'000'000'000);
      const std::int64_t now = scheduled + draw(0, (i % 3 == 0 ? 2 : 1000) * period);
      const auto bound = static_cast<std::uint64_t>(draw(0, 100));
      visit(scheduled, now, period, bound, nextWakeUp(policy, scheduled, now, period, bound));
    }
  }
};

TEST_F(OverrunPolicyProperty, ThePhaseIsKept) {
  for (const auto policy : {OverrunPolicy::kSkip, OverrunPolicy::kCatchUp, OverrunPolicy::kStop}) {
    forMany(policy, [](auto scheduled, auto, auto period, auto, const WakeUp& found) {
      ASSERT_EQ((found.next - scheduled) % period, 0);
      ASSERT_EQ((found.next - scheduled) / period, static_cast<std::int64_t>(found.skipped) + 1);
    });
  }
}

TEST_F(OverrunPolicyProperty, OverrunMeansThatTheNextCycleWasDueBefore) {
  for (const auto policy : {OverrunPolicy::kSkip, OverrunPolicy::kCatchUp, OverrunPolicy::kStop}) {
    forMany(policy, [policy](auto scheduled, auto now, auto period, auto, const WakeUp& found) {
      ASSERT_EQ(found.overrun, now > scheduled + period);
      ASSERT_EQ(found.stop, found.overrun && policy == OverrunPolicy::kStop);
    });
  }
}

TEST_F(OverrunPolicyProperty, SkipWakesAtTheFirstInstantThatIsNotPast) {
  forMany(OverrunPolicy::kSkip,
          [](auto scheduled, auto now, auto period, auto, const WakeUp& found) {
            ASSERT_GE(found.next, now);
            ASSERT_TRUE(found.next - period < now || found.next == scheduled + period);
          });
}

TEST_F(OverrunPolicyProperty, CatchUpIsNeverFurtherBehindThanItsBound) {
  forMany(OverrunPolicy::kCatchUp,
          [](auto, auto now, auto period, auto bound, const WakeUp& found) {
            ASSERT_LE(now - found.next, static_cast<std::int64_t>(bound) * period);
          });
}

TEST_F(OverrunPolicyProperty, CatchUpSkipsOnlyWhatItsBoundForbids) {
  forMany(OverrunPolicy::kCatchUp,
          [](auto, auto now, auto period, auto bound, const WakeUp& found) {
            if (found.skipped > 0) {
              // Were one period fewer skipped, the loop would be more than the bound behind.
              ASSERT_GT(now - (found.next - period), static_cast<std::int64_t>(bound) * period);
            }
          });
}

// Cycles that take no time, after one that took 12.5 periods: catch_up regains the grid of the
// clock, having run the bound's number of cycles late and having skipped the rest.
TEST(OverrunPolicy, CatchUpRunsLateCyclesBackToBackAndIsThenInTime) {
  const std::int64_t now = 1250;
  std::int64_t scheduled = 0;
  std::uint64_t skipped = 0;
  int run_late = 0;
  for (;;) {
    const WakeUp found = nextWakeUp(OverrunPolicy::kCatchUp, scheduled, now, 100, 5);
    skipped += found.skipped;
    scheduled = found.next;
    if (scheduled >= now) {
      break;
    }
    ++run_late;
  }
  EXPECT_EQ(run_late, 5);  // due at 800, 900, 1000, 1100, 1200
  EXPECT_EQ(skipped, 7U);  // due at 100 to 700
  EXPECT_EQ(scheduled, 1300);
}

TEST(OverrunPolicy, NamesAreReadAsTheyAreWritten) {
  EXPECT_EQ(toString(OverrunPolicy::kSkip), "skip");
  EXPECT_EQ(toString(OverrunPolicy::kCatchUp), "catch_up");
  EXPECT_EQ(toString(OverrunPolicy::kStop), "stop");
  for (const auto policy : {OverrunPolicy::kSkip, OverrunPolicy::kCatchUp, OverrunPolicy::kStop}) {
    EXPECT_EQ(parseOverrunPolicy(toString(policy)), policy);
  }
}

TEST(OverrunPolicy, AnUnknownNameIsRefusedWithWhatIsExpected) {
  try {
    parseOverrunPolicy("Skip");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "overrun policy: must be skip, catch_up or stop, found \"Skip\"");
  }
}

}  // namespace overrun_policy_test
}  // namespace whirl_twin
