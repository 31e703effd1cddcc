// Resonance capture of a shaft: its detection, the response to it, and the number of attempts.
#include "controllers/capture_supervisor.h"

#include <gtest/gtest.h>

namespace whirl_twin {
namespace capture_supervisor_test {

using Order = CaptureSupervisor::Order;
using state::Supervision;

constexpr SpeedBand kBand{180.0, 220.0};
constexpr double kPeriod = 0.01;

/// A band that is crossed in 4 s: 400 samples a window; run-up 5 rad/s.
CaptureSupervisor supervisor() {
  return CaptureSupervisor({{kBand}, 5.0, 10.0, 2.0, kPeriod});
}

CaptureSupervisor::Look at(double speed, bool at_limit = true, bool arrived = false) {
  return {speed, 300.0, 10.0, at_limit, arrived};
}

/// Feeds a speed that rises [rad/s^2]; returns the first order within so many samples.
Order first(CaptureSupervisor& s, double from, double rise, int samples, bool at_limit = true) {
  for (int k = 0; k < samples; ++k) {
    const Order order = s.look(at(from + rise * kPeriod * k, at_limit));
    if (order != Order::kNone) {
      return order;
    }
  }
  return Order::kNone;
}

TEST(CaptureSupervisor, RecognisesWhatStandsStillAtTheLimitNearABand) {
  CaptureSupervisor held = supervisor();
  EXPECT_EQ(first(held, 197.0, 0.0, 799), Order::kNone) << "two windows";
  EXPECT_EQ(first(held, 197.0, 0.0, 1), Order::kUnload);
  EXPECT_TRUE(held.unloads());
  EXPECT_EQ(held.state(), Supervision::kRetreating);
  CaptureSupervisor below = supervisor();
  EXPECT_EQ(first(below, 150.0, 0.0, 800), Order::kUnload) << "as far below as the band is wide";
  CaptureSupervisor slow = supervisor();
  EXPECT_EQ(first(slow, 181.0, 0.19, 5000), Order::kUnload) << "a fiftieth of the plan is 0.2";
}

TEST(CaptureSupervisor, LeavesAloneWhatGoesOn) {
  CaptureSupervisor creeping = supervisor();
  EXPECT_EQ(first(creeping, 181.0, 0.21, 15000), Order::kNone);
  CaptureSupervisor unlimited = supervisor();
  EXPECT_EQ(first(unlimited, 197.0, 0.0, 5000, false), Order::kNone);
  CaptureSupervisor beyond = supervisor();
  EXPECT_EQ(first(beyond, 221.0, 0.0, 5000), Order::kNone);
  CaptureSupervisor far = supervisor();
  EXPECT_EQ(first(far, 139.0, 0.0, 5000), Order::kNone);
  CaptureSupervisor elsewhere = supervisor();
  for (int k = 0; k < 5000; ++k) {
    ASSERT_EQ(elsewhere.look({179.0, 180.0, 10.0, true, false}), Order::kNone) << "does not cross";
  }
}

TEST(CaptureSupervisor, RetreatsTriesAgainAndGivesUp) {
  CaptureSupervisor s = supervisor();
  for (const Order then : {Order::kRetry, Order::kNone}) {
    ASSERT_EQ(first(s, 197.0, 0.0, 800), Order::kUnload);
    EXPECT_EQ(s.look(at(190.0)), Order::kNone);
    EXPECT_EQ(s.look(at(179.9)), Order::kReturn);
    EXPECT_FALSE(s.unloads());
    EXPECT_EQ(s.runUpOf(s.band()), 175.0);
    for (int k = 0; k < 1000; ++k) {
      ASSERT_EQ(s.look(at(176.0, false, false)), Order::kNone) << "it is not there yet";
    }
    for (int k = 1; k < 400; ++k) {
      ASSERT_EQ(s.look(at(175.0, false, true)), Order::kNone);
    }
    EXPECT_EQ(s.look(at(175.0, false, true)), then);
  }
  EXPECT_EQ(s.state(), Supervision::kGivenUp);
  EXPECT_EQ(first(s, 197.0, 0.0, 5000), Order::kNone);
  s.reset(false);
  EXPECT_EQ(s.state(), Supervision::kNone);
  EXPECT_EQ(first(s, 197.0, 0.0, 800), Order::kUnload) << "anew";
}

TEST(CaptureSupervisor, CountsAnewOnceABandIsPassed) {
  CaptureSupervisor s = supervisor();
  ASSERT_EQ(first(s, 197.0, 0.0, 800), Order::kUnload);
  s.look(at(179.0));
  for (int k = 0; k < 400; ++k) {
    s.look(at(175.0, false, true));
  }
  EXPECT_EQ(s.state(), Supervision::kTryingAgain);
  s.look(at(221.0));
  EXPECT_EQ(s.state(), Supervision::kNone);
}

TEST(CaptureSupervisor, DoesNotTryWhatIsRefused) {
  CaptureSupervisor s = supervisor();
  s.reset(true);
  EXPECT_EQ(s.state(), Supervision::kRefused);
  EXPECT_EQ(first(s, 197.0, 0.0, 5000), Order::kNone);
}

}  // namespace capture_supervisor_test
}  // namespace whirl_twin
