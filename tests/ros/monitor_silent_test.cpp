// The monitor publishes its heartbeat as long as it runs, also during a pause; when it dies the
// simulation's diagnostics report it.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/MonitorStatus.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "waiting.h"

namespace whirl_twin {
namespace monitor_silent_test {

TEST(MonitorSilent, ItsDeathIsSeen) {
  ros::NodeHandle node;
  int beats = 0;
  std::optional<MonitorStatus> last;
  std::string loop_says;
  const boost::function<void(const MonitorStatus::ConstPtr&)> on_beat =
      [&](const MonitorStatus::ConstPtr& m) {
        ++beats;
        last = *m;
      };
  const boost::function<void(const diagnostic_msgs::DiagnosticArray::ConstPtr&)> on_diagnostics =
      [&](const diagnostic_msgs::DiagnosticArray::ConstPtr& m) {
        for (const auto& status : m->status) {
          if (status.name.find("real-time loop") != std::string::npos) {
            loop_says = status.message;
          }
        }
      };
  const auto beat = node.subscribe<MonitorStatus>("/twin/monitor", 10, on_beat);
  const auto diagnostics =
      node.subscribe<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10, on_diagnostics);
  ASSERT_TRUE(waitUntil([&] { return last && last->time > 0.5 && !loop_says.empty(); }));
  ASSERT_EQ(last->system.size(), 2u);
  EXPECT_GE(last->verdict_age[0], 0.0);
  EXPECT_EQ(loop_says.find("monitor"), std::string::npos) << loop_says;

  std_srvs::Trigger pause;
  ASSERT_TRUE(ros::service::waitForService("/simulation_node/pause", 20000));
  ASSERT_TRUE(ros::service::call("/simulation_node/pause", pause));
  const int before = beats;
  EXPECT_TRUE(waitUntil([&] { return beats > before + 2 && last->paused; }));

  ASSERT_EQ(std::system("rosnode kill /monitor_node > /dev/null"), 0);
  EXPECT_TRUE(waitUntil([&] {
    return loop_says.find("no message from the monitor") != std::string::npos;
  })) << loop_says;
}

}  // namespace monitor_silent_test
}  // namespace whirl_twin
