// The heartbeat reports the alerts and the age of the verdicts; one that has stopped is missed, one
// that never came is not.
#include "messages/monitor_status.h"

#include <gtest/gtest.h>

#include "watched_twin.h"

namespace whirl_twin {
namespace monitor_status_test {

TEST(MonitorStatus, TellsTheAgeOfEveryVerdictAndCountsAlerts) {
  WatchedTwin watched(sceneOf(R"(
name: two
step: 0.001
drives: {shaft: {speed: 250.0}}
systems:
  growing:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 10.0}
    initial: {x: 1.0e-9}
  calm:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0}
)"));
  const state::MonitorStatus first = watched.monitor.status(0.0, false);
  ASSERT_EQ(first.system.size(), 2u);
  EXPECT_TRUE(std::isnan(first.verdict_age[0])) << "no state received";
  watched.run(0.55);
  const state::MonitorStatus status = watched.monitor.status(watched.wall + 2.0, true);
  EXPECT_EQ(status.at.step, 550);
  EXPECT_NEAR(status.at.time, 0.55, 1.0e-9);
  EXPECT_TRUE(status.paused);
  EXPECT_EQ(status.alerts, 1);
  EXPECT_EQ(status.dangers, 1);
  for (const double age : status.verdict_age) {
    EXPECT_GE(age, 2.0);
    EXPECT_LE(age, 2.1) << "judged ten times a second";
  }
}

TEST(MonitorPulse, IsMissedAfterThreeSeconds) {
  MonitorPulse pulse;
  EXPECT_EQ(pulse.silence(1000.0), "") << "never heard: a twin may run without";
  pulse.beat(10.0);
  EXPECT_EQ(pulse.silence(12.9), "");
  EXPECT_EQ(pulse.silence(15.2), "no message from the monitor for 5 s: nothing is monitored");
  pulse.beat(16.0);
  EXPECT_EQ(pulse.silence(16.5), "");
}

}  // namespace monitor_status_test
}  // namespace whirl_twin
