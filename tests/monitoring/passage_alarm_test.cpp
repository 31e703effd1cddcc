// A resonance that keeps a shaft from its speed: the alert says what is done about it.
#include <gtest/gtest.h>

#include "messages/alert.h"
#include "monitoring/controller_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace passage_alarm_test {

using state::Supervision;

state::ControllerState stateAt(double time, Supervision supervision) {
  state::ControllerState state;
  state.at.time = time;
  state.controller = "governor";
  state.supervision = supervision;
  return state;
}

ControllerSpec governor() {
  ControllerSpec spec;
  spec.name = "governor";
  spec.weak_passages = {{{90.0, 110.0}, 100.0, 0.5, 0.4, true},
                        {{180.0, 220.0}, 199.5, 0.6, 0.4, false}};
  return spec;
}

TEST(PassageAlarm, SaysWhatIsDoneAboutACapture) {
  AlertList list;
  ControllerAlarms alarm(governor(), AlarmSettings{});
  alarm.update(stateAt(0.0, Supervision::kNone), list);
  EXPECT_TRUE(list.active().empty());
  const auto text = [&](double time, Supervision supervision) {
    alarm.update(stateAt(time, supervision), list);
    const state::Alert* alert = list.find("governor", alert_type::kResonanceNotPassed);
    return alert == nullptr ? std::string() : alert->text;
  };
  EXPECT_NE(text(1.0, Supervision::kRetreating).find("capture"), std::string::npos);
  EXPECT_EQ(list.active()[0].severity, state::Severity::kDanger);
  const auto id = list.active()[0].id;
  EXPECT_NE(text(2.0, Supervision::kTryingAgain).find("tries again"), std::string::npos);
  EXPECT_NE(text(3.0, Supervision::kGivenUp).find("gave up"), std::string::npos);
  ASSERT_EQ(list.active().size(), 1u);
  EXPECT_EQ(list.active()[0].id, id) << "one alert";
  text(4.0, Supervision::kNone);
  text(9.0, Supervision::kNone);
  EXPECT_TRUE(list.active().empty());
}

TEST(PassageAlarm, SaysWhatIsRefusedAndWhy) {
  AlertList list;
  ControllerAlarms alarm(governor(), AlarmSettings{});
  alarm.update(stateAt(0.0, Supervision::kRefused), list);
  ASSERT_EQ(list.active().size(), 1u);
  EXPECT_EQ(list.active()[0].severity, state::Severity::kWarning);
  const std::string text = list.active()[0].text;
  for (const char* part :
       {"governor", "does not start", "180 to 220 rad/s", "0.6 N m", "0.4 N m"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
}

}  // namespace passage_alarm_test
}  // namespace whirl_twin
