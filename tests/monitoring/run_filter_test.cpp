// Of two twins on the same channels, those who show or hand on keep to one.
#include "monitoring/run_filter.h"

#include <gtest/gtest.h>

namespace whirl_twin {
namespace run_filter_test {

constexpr std::int64_t kSecond = 1'000'000'000;  // ns

/// A twin that sends a state each 10 ms, and statistics each second.
struct Sender {
  std::string name;
  std::int64_t started;  // ns, of the wall clock
  double time;           // [s], simulated, at the begin
  int passed = 0;

  void send(RunFilter& filter, int tick) {
    const double now = 0.01 * tick;
    state::WhirlState whirl;
    whirl.at = {tick, time + now, 100 * kSecond + static_cast<std::int64_t>(1.0e9 * now)};
    if (tick % 100 == 0) {
      state::LoopStatistics loop;
      loop.at = whirl.at;
      loop.started = started;
      loop.sender = name;
      filter.take(Message(loop), now);
    }
    passed += filter.take(Message(whirl), now) ? 1 : 0;
  }
};

TEST(ARunFilter, LetsOneOfTwoTwinsPassAndNamesTheOther) {
  RunFilter filter;
  Sender watched{"first", 90 * kSecond, 10.0};
  Sender other{"second", 95 * kSecond, 0.0};
  for (int tick = 0; tick < 1000; ++tick) {
    watched.send(filter, tick);
    if (tick >= 300) {
      other.send(filter, tick);
    }
  }
  EXPECT_EQ(watched.passed, 1000);
  EXPECT_EQ(other.passed, 0);
  EXPECT_EQ(filter.ofOthers(), 707U);  // and seven statistics
  EXPECT_EQ(filter.duplicate(10.0),
            "duplicate publisher: second publishes as this twin beside first");
}

TEST(ARunFilter, FollowsATwinThatIsStartedAgain) {
  RunFilter filter;
  Sender before{"first", 90 * kSecond, 10.0};
  Sender after{"first", 103 * kSecond, 0.0};
  for (int tick = 0; tick < 300; ++tick) {
    before.send(filter, tick);
  }
  for (int tick = 300; tick < 1000; ++tick) {
    after.send(filter, tick);
  }
  EXPECT_GE(after.passed, 300);  // from 2.5 s of silence on, and one or two statistics
  EXPECT_EQ(filter.duplicate(10.0), "");
}

TEST(ARunFilter, LetsALogAndMeasurementsOfNobodyPass) {
  RunFilter filter;
  for (int tick = 0; tick < 100; ++tick) {
    EXPECT_TRUE(filter.take(tick, 1.0 * tick, 0.001 * tick));
  }
  EXPECT_EQ(filter.ofOthers(), 0U);
}

// The monitor publishes active alerts again every 5 s, for late subscribers.
TEST(ARunFilter, LetsAlertsPassThatAreToldAgainWithoutAStamp) {
  RunFilter filter;
  Sender watched{"first", 90 * kSecond, 10.0};
  int passed = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    watched.send(filter, tick);
    if (tick % 100 == 50) {
      state::Alert alert;
      alert.time = watched.time + 0.01 * tick;
      passed += filter.take(Message(alert), 0.01 * tick) ? 1 : 0;
    }
  }
  EXPECT_EQ(passed, 30);
  EXPECT_EQ(filter.ofOthers(), 0U);
  EXPECT_EQ(filter.duplicate(30.0), "");
}

TEST(ARunFilter, LeavesALogThatIsPlayedBesideATwin) {
  RunFilter filter;
  Sender watched{"first", 90 * kSecond, 10.0};
  int passed = 0;
  for (int tick = 0; tick < 300; ++tick) {
    watched.send(filter, tick);
    passed += filter.take(50 * kSecond + tick, 5.0, 0.01 * tick) ? 1 : 0;
  }
  EXPECT_EQ(watched.passed, 300);
  EXPECT_LE(passed, 0);
}

}  // namespace run_filter_test
}  // namespace whirl_twin
