// No messages from one system while others are received. Wall time is simulated: nothing waits.
#include <gtest/gtest.h>

#include "messages/alert.h"
#include "monitoring/data_alarms.h"

namespace whirl_twin {
namespace data_lost_alarm_test {

class DataLostAlarmTest : public testing::Test {
 protected:
  // The sources send every 10 ms of wall time, from..to [s]; simulated time runs at half speed.
  void send(const std::vector<std::string>& sources, double from, double to) {
    for (double wall = from; wall < to; wall += 0.01) {
      for (const std::string& source : sources) {
        alarm_.received(source, wall, 0.5 * wall, list_);
      }
    }
  }
  bool lost(const std::string& system) const {
    return list_.find(system, alert_type::kDataLost) != nullptr;
  }

  // The clear delay is shorter than the timeout.
  static AlarmSettings settings() {
    AlarmSettings settings;
    settings.data_timeout = 1.0;
    settings.clear_delay = 0.5;
    return settings;
  }

  AlertList list_;
  DataLostAlarm alarm_{{"a", "b"}, settings()};
};

TEST_F(DataLostAlarmTest, ASystemSilentAmongOthersIsLostAfterTheTimeoutAndBackAfterTheDelay) {
  send({"a", "b"}, 0.0, 5.0);
  EXPECT_TRUE(list_.active().empty());
  send({"a"}, 5.0, 5.9);
  EXPECT_TRUE(list_.active().empty());
  send({"a"}, 5.9, 6.1);
  ASSERT_TRUE(lost("b"));
  EXPECT_FALSE(lost("a"));
  EXPECT_EQ(list_.active()[0].severity, state::Severity::kWarning);
  EXPECT_NEAR(list_.active()[0].raised_time, 3.0, 0.05) << "simulated time";
  send({"a", "b"}, 6.1, 6.5);
  EXPECT_TRUE(lost("b"));
  send({"a", "b"}, 6.5, 6.7);
  EXPECT_FALSE(lost("b"));
  EXPECT_EQ(list_.takeEvents().size(), 2u);
}

TEST_F(DataLostAlarmTest, APauseOfEverybodyLosesNobody) {
  send({"a", "b"}, 0.0, 2.0);
  // a alone sends a little longer than b before the pause, and is the first one after it.
  send({"a"}, 2.0, 2.5);
  send({"a"}, 60.0, 60.5);
  EXPECT_TRUE(list_.active().empty());
  send({"a", "b"}, 60.5, 62.0);
  EXPECT_TRUE(list_.active().empty());
}

TEST_F(DataLostAlarmTest, APauseDoesNotBringALostSystemBack) {
  send({"a", "b"}, 0.0, 1.0);
  send({"a"}, 1.0, 3.0);
  ASSERT_TRUE(lost("b"));
  send({"a"}, 60.0, 65.0);
  EXPECT_TRUE(lost("b"));
  EXPECT_EQ(list_.takeEvents().size(), 1u) << "one alert all along";
}

TEST_F(DataLostAlarmTest, ASystemNeverHeardOfIsLostToo) {
  send({"a"}, 0.0, 2.0);
  EXPECT_TRUE(lost("b"));
}

TEST_F(DataLostAlarmTest, ADriveShowsThatOthersGoOnWithoutBeingWatchedItself) {
  send({"a", "b", "drive"}, 0.0, 1.0);
  send({"drive"}, 1.0, 3.0);
  EXPECT_TRUE(lost("a"));
  EXPECT_TRUE(lost("b"));
  send({"a", "b"}, 3.0, 6.0);
  EXPECT_TRUE(list_.active().empty());
}

TEST_F(DataLostAlarmTest, EverybodySilentWithoutAPauseMeansThatNothingIsWatched) {
  alarm_.tick(100.0, 0.0, false, list_);
  EXPECT_TRUE(list_.active().empty()) << "nothing was ever heard: nothing was promised";
  send({"a", "b"}, 0.0, 2.0);
  alarm_.tick(2.5, 1.0, false, list_);
  EXPECT_TRUE(list_.active().empty()) << "within the timeout";
  alarm_.tick(10.0, 1.0, true, list_);
  EXPECT_TRUE(list_.active().empty()) << "paused";
  alarm_.tick(10.1, 1.0, false, list_);
  EXPECT_TRUE(lost("twin"));
  EXPECT_FALSE(lost("a")) << "one alert, not one a system";
  send({"a", "b"}, 20.0, 20.2);
  alarm_.tick(20.2, 10.1, false, list_);
  EXPECT_TRUE(lost("twin")) << "not before the clear delay";
  send({"a", "b"}, 20.2, 21.0);
  alarm_.tick(21.0, 10.5, false, list_);
  EXPECT_FALSE(lost("twin"));
}

}  // namespace data_lost_alarm_test
}  // namespace whirl_twin
