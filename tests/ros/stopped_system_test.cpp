// A non-finite state stops its own system, with an alert, and no other.

#include <gtest/gtest.h>
#include <whirl_twin/AlertArray.h>
#include <whirl_twin/LoopStatistics.h>
#include <whirl_twin/WhirlState.h>

#include <algorithm>
#include <optional>

#include "waiting.h"

namespace whirl_twin {
namespace stopped_system_test {

TEST(StoppedSystem, isReportedWhileTheOthersGoOn) {
  ros::NodeHandle node("/twin");
  std::optional<LoopStatistics> loop;
  std::optional<Alert> not_finite;
  std::int64_t rotor_step = -1;
  const boost::function<void(const LoopStatistics::ConstPtr&)> on_loop =
      [&](const LoopStatistics::ConstPtr& m) { loop = *m; };
  const boost::function<void(const AlertArray::ConstPtr&)> on_alerts =
      [&](const AlertArray::ConstPtr& list) {
        for (const Alert& a : list->alerts) {
          if (a.type == "NOT_FINITE") {
            not_finite = a;
          }
        }
      };
  const boost::function<void(const WhirlState::ConstPtr&)> on_whirl =
      [&](const WhirlState::ConstPtr& m) { rotor_step = m->step; };
  const std::vector<ros::Subscriber> subscribers{
      node.subscribe<LoopStatistics>("loop", 10, on_loop),
      node.subscribe<AlertArray>("alerts", 10, on_alerts),
      node.subscribe<WhirlState>("rotor/whirl", 10000, on_whirl)};

  ASSERT_TRUE(waitUntil([&] { return not_finite.has_value() && loop.has_value(); }));
  EXPECT_EQ(not_finite->system, "runaway");
  EXPECT_EQ(not_finite->severity, Alert::DANGER);
  EXPECT_NE(not_finite->text.find("runaway"), std::string::npos);
  EXPECT_NE(not_finite->text.find("theta1"), std::string::npos) << not_finite->text;

  const auto index = static_cast<std::size_t>(
      std::find(loop->system.begin(), loop->system.end(), "runaway") - loop->system.begin());
  ASSERT_LT(index, loop->stopped.size());
  EXPECT_EQ(loop->stopped[index], 1);

  const std::int64_t then = rotor_step;
  EXPECT_TRUE(waitUntil([&] { return rotor_step > then + 500; }));
}

}  // namespace stopped_system_test
}  // namespace whirl_twin
