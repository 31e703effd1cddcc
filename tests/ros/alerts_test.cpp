// A run-up through a critical speed, live: the approach is announced before the rotor enters the
// band, the band while it is inside, and both alerts clear after it has left.

#include <gtest/gtest.h>
#include <whirl_twin/AlertArray.h>
#include <whirl_twin/DriveState.h>
#include <whirl_twin/StabilityMargin.h>

#include <algorithm>
#include <optional>

#include "waiting.h"

namespace whirl_twin {
namespace alerts_test {

/// The content of the latched list over time.
struct AlertLog {
  std::optional<Alert> approach;  // as first raised
  std::optional<Alert> band;
  bool both_gone = false;  // after the band alert had been there
  std::size_t raised = 0;  // ids seen

  void take(const AlertArray& list) {
    const auto find = [&](const std::string& type) -> const Alert* {
      const auto a = std::find_if(list.alerts.begin(), list.alerts.end(),
                                  [&](const Alert& alert) { return alert.type == type; });
      return a == list.alerts.end() ? nullptr : &*a;
    };
    if (const Alert* a = find("CRITICAL_SPEED_APPROACH"); a != nullptr && !approach) {
      approach = *a;
    }
    if (const Alert* a = find("IN_CRITICAL_BAND"); a != nullptr && !band) {
      band = *a;
    }
    for (const Alert& a : list.alerts) {
      raised = std::max<std::size_t>(raised, a.id);
    }
    both_gone = band && list.alerts.empty();
  }
};

TEST(Alerts, aRunUpIsAnnouncedAccompaniedAndCleared) {
  ros::NodeHandle node("/twin");
  AlertLog log;
  std::optional<StabilityMargin> margin;
  const boost::function<void(const AlertArray::ConstPtr&)> on_alerts =
      [&](const AlertArray::ConstPtr& m) { log.take(*m); };
  const boost::function<void(const StabilityMargin::ConstPtr&)> on_margin =
      [&](const StabilityMargin::ConstPtr& m) { margin = *m; };
  const ros::Subscriber alerts = node.subscribe<AlertArray>("alerts", 100, on_alerts);
  const ros::Subscriber margins =
      node.subscribe<StabilityMargin>("rotor/stability", 100, on_margin);

  ASSERT_TRUE(waitUntil([&] { return log.approach.has_value(); }));
  ASSERT_TRUE(waitUntil([&] { return log.band.has_value(); }));
  ASSERT_TRUE(waitUntil([&] { return log.both_gone; }));
  ASSERT_TRUE(margin.has_value());
  ASSERT_EQ(margin->critical_speed.size(), 1u);

  // Jeffcott rotor: zeta = 12 / (2 sqrt(2 * 7200)) = 0.05, Nc = 60 / sqrt(1 - 2 zeta^2).
  EXPECT_NEAR(margin->critical_speed[0], 60.0 / std::sqrt(1.0 - 2.0 * 0.05 * 0.05), 1.0e-9);
  EXPECT_NEAR(margin->damping_ratio, 0.05, 1.0e-12);
  EXPECT_EQ(margin->verdict, StabilityMargin::ASYMPTOTICALLY_STABLE);

  EXPECT_LT(log.approach->speed, margin->band_low[0]);
  EXPECT_GT(log.approach->time_to_entry, 0.0);
  EXPECT_LE(log.approach->time_to_entry, 2.0);
  EXPECT_GE(log.band->speed, margin->band_low[0]);
  EXPECT_LE(log.band->speed, margin->band_high[0]);
  EXPECT_GT(log.band->raised_time, log.approach->raised_time);
  EXPECT_EQ(log.raised, 2u);  // no duplicate alert, and no other one
}

TEST(Alerts, theListIsLatched) {
  ros::NodeHandle node("/twin");
  bool heard = false;
  const boost::function<void(const AlertArray::ConstPtr&)> on_alerts =
      [&](const AlertArray::ConstPtr&) { heard = true; };
  const ros::Subscriber late = node.subscribe<AlertArray>("alerts", 1, on_alerts);
  EXPECT_TRUE(waitUntil([&] { return heard; }));
}

}  // namespace alerts_test
}  // namespace whirl_twin
