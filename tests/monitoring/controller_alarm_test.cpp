// A controller in another process that does not answer, as the twin tells it.
#include "monitoring/controller_alarm.h"

#include <gtest/gtest.h>

#include "messages/alert.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace controller_alarm_test {

TEST(ControllerAlarm, NamesWhatIsLostAndClearsWhenItAnswersAgain) {
  AlertList list;
  ControllerAlarm alarm("pd", AlarmSettings{});
  alarm.update(0.0, false, list);
  EXPECT_TRUE(list.active().empty());
  alarm.update(0.1, true, list);
  ASSERT_NE(list.find("pd", alert_type::kControllerLost), nullptr);
  EXPECT_EQ(list.active()[0].severity, state::Severity::kDanger);
  EXPECT_NE(list.active()[0].text.find("pd"), std::string::npos);
  alarm.update(0.2, false, list);
  alarm.update(2.0, false, list);
  EXPECT_TRUE(list.active().empty());
}

}  // namespace controller_alarm_test
}  // namespace whirl_twin
