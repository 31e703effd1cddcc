// A controller in another process that does not answer, as the twin publishes it.
#include <gtest/gtest.h>

#include "messages/alert.h"
#include "monitoring/controller_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace controller_alarm_test {

TEST(ControllerAlarm, NamesWhatIsLostAndClearsWhenItAnswersAgain) {
  AlertList list;
  ControllerAlarms alarm(controllerNamed("pd"), AlarmSettings{});
  const auto update = [&](double time, bool lost) {
    state::ControllerState state;
    state.at.time = time;
    state.lost = lost;
    alarm.update(state, list);
  };
  update(0.0, false);
  EXPECT_TRUE(list.active().empty());
  update(0.1, true);
  ASSERT_NE(list.find("pd", alert_type::kControllerLost), nullptr);
  EXPECT_EQ(list.active()[0].severity, state::Severity::kDanger);
  EXPECT_NE(list.active()[0].text.find("pd"), std::string::npos);
  update(0.2, false);
  update(2.0, false);
  EXPECT_TRUE(list.active().empty());
}

}  // namespace controller_alarm_test
}  // namespace whirl_twin
