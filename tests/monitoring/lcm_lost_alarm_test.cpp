// Messages that LCM cannot send, as the simulation's statistics tell them once a second.
#include <gtest/gtest.h>

#include "messages/alert.h"
#include "monitoring/data_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace lcm_lost_alarm_test {

TEST(LcmLostAlarm, StandsWhileMessagesAreLostAndClearsAfterTheDelay) {
  AlertList list;
  LcmLostAlarm alarm{AlarmSettings{}};
  const auto stands = [&list] {
    return list.find(alert_type::kEverybody, alert_type::kLcmLost) != nullptr;
  };
  alarm.update(0.0, 0.0, 70, list);
  EXPECT_FALSE(stands()) << "what was lost before anybody listened is no news";
  alarm.update(1.0, 1.0, 70, list);
  EXPECT_FALSE(stands());
  alarm.update(2.0, 2.0, 75, list);
  ASSERT_TRUE(stands());
  EXPECT_NE(list.active()[0].text.find("5 messages, 75 since"), std::string::npos)
      << list.active()[0].text;
  alarm.update(3.0, 3.0, 1075, list);
  alarm.update(4.0, 4.0, 1075, list);
  EXPECT_TRUE(stands()) << "the delay has only begun";
  alarm.update(5.1, 5.1, 1075, list);
  EXPECT_FALSE(stands());
  EXPECT_EQ(list.takeEvents().size(), 2u);
}

TEST(LcmLostAlarm, ATwinThatWasStartedAgainCountsFromNothing) {
  AlertList list;
  LcmLostAlarm alarm{AlarmSettings{}};
  alarm.update(0.0, 0.0, 1000, list);
  alarm.update(1.0, 1.0, 3, list);
  EXPECT_TRUE(list.active().empty());
  alarm.update(2.0, 2.0, 4, list);
  EXPECT_EQ(list.active().size(), 1u);
}

TEST(LcmLostAlarm, IsRaisedByWhatTheSimulationSaysAndGoneAfterAReset) {
  WatchedTwin watched(sceneOf(R"(
name: slow
step: 0.001
drives: {shaft: {speed: 10.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 1.0e-5}
)"));
  watched.run(0.1);
  watched.announce();
  watched.loop.lcm_failed = 12;
  watched.run(0.1);
  watched.announce();
  EXPECT_NE(watched.monitor.alerts().find(alert_type::kEverybody, alert_type::kLcmLost), nullptr);
  watched.twin.reset();
  watched.run(0.05);
  ++watched.loop.epoch;
  watched.announce();
  watched.run(0.05);
  watched.announce();
  EXPECT_TRUE(watched.monitor.alerts().active().empty()) << "what was lost before is told";
}

}  // namespace lcm_lost_alarm_test
}  // namespace whirl_twin
