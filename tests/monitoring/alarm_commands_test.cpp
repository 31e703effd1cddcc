// What people tell the monitor about its alarms: done as asked, or refused whole and said why.
#include "monitoring/alarm_commands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "messages/alert.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace alarm_commands_test {

constexpr char kTwo[] = R"(
name: two
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, speed: 50.0}
  pump:
    model: jeffcott_rotor
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, speed: 50.0}
)";

struct Commanded {
  Commanded() : monitor(build(sceneOf(kTwo)), settings()) {}
  static AlarmSettings settings() {
    AlarmSettings settings;
    settings.latch = Latch::kAll;
    settings.amplitude["rotor"].alert = settings.amplitude["pump"].alert = {1.0e-3};
    return settings;
  }
  /// Both whirl so wide [m] for a while [s].
  void tell(double radius, double duration) {
    for (const double end = time + duration; time < end - 1.0e-9; time += 0.01) {
      for (const char* system : {"rotor", "pump"}) {
        monitor.take(circularWhirl(system, time, radius, 50.0), time);
      }
      monitor.tick(time, false);
    }
  }
  CommandAnswer command(int command, const std::string& system = "", const std::string& type = "",
                        double duration = 0.0) {
    state::AlarmCommand order;
    order.command = static_cast<std::uint8_t>(command);
    order.system = system;
    order.type = type;
    order.duration = duration;
    return carryOut(order, monitor, time, "the desk");
  }
  const state::Alert* alertOf(const std::string& system) {
    return monitor.alerts().find(system, alert_type::kWhirlAmplitude);
  }

  TwinMonitor monitor;
  double time = 0.0;  ///< [s], simulated and wall
};

constexpr int kAcknowledge = state::AlarmCommand::kAcknowledge;
constexpr int kReset = state::AlarmCommand::kReset;
constexpr int kInhibit = state::AlarmCommand::kInhibit;

TEST(AlarmCommands, AcknowledgeTheAlertsOfOneSystemAndLeaveTheOthers) {
  Commanded twin;
  twin.tell(2.0e-3, 0.4);
  const CommandAnswer answer = twin.command(kAcknowledge, "rotor", "WHIRL_AMPLITUDE");
  EXPECT_TRUE(answer.done);
  EXPECT_EQ(answer.text, "1 acknowledged");
  EXPECT_TRUE(twin.alertOf("rotor")->acknowledged);
  EXPECT_FALSE(twin.alertOf("pump")->acknowledged);
  EXPECT_TRUE(twin.command(kAcknowledge).done) << "all of them";
  EXPECT_TRUE(twin.alertOf("pump")->acknowledged);
}

TEST(AlarmCommands, AResetTakesOffWhatIsLatchedAndOnlyThat) {
  Commanded twin;
  twin.tell(2.0e-3, 0.4);
  EXPECT_EQ(twin.command(kReset).text, "0 cleared, 2 still active because their cause persists");
  twin.tell(0.1e-3, 2.0);
  ASSERT_TRUE(twin.alertOf("rotor")->latched);
  EXPECT_EQ(twin.command(kReset).text, "2 cleared, 0 still active because their cause persists");
  EXPECT_EQ(twin.alertOf("rotor"), nullptr);
}

TEST(AlarmCommands, AnInhibitionHoldsBackOneSystemUntilItIsEnded) {
  Commanded twin;
  twin.tell(0.1e-3, 0.4);
  EXPECT_TRUE(twin.command(kInhibit, "rotor", "", 100.0).done);
  twin.tell(2.0e-3, 1.0);
  EXPECT_EQ(twin.alertOf("rotor"), nullptr);
  EXPECT_NE(twin.alertOf("pump"), nullptr);
  EXPECT_TRUE(twin.command(kInhibit, "rotor").done);
  twin.tell(2.0e-3, 0.4);
  EXPECT_NE(twin.alertOf("rotor"), nullptr);
}

// What silences is in the list of alerts itself: with its sender and its times, bounded, with an
// end.
TEST(AlarmCommands, AnInhibitionIsAnAlertUntilItEnds) {
  Commanded twin;
  twin.tell(0.1e-3, 0.4);
  EXPECT_EQ(twin.command(kInhibit, "", "", 3600.0).text,
            "alerts of every system are inhibited for 900 s (max_inhibition), not 3600 s");
  for (const char* system : {"rotor", "pump"}) {
    const state::Alert* alert = twin.monitor.alerts().find(system, alert_type::kInhibited);
    ASSERT_NE(alert, nullptr);
    EXPECT_EQ(alert->severity, state::Severity::kWarning);
    EXPECT_NE(alert->text.find("by the desk since 20"), std::string::npos) << alert->text;
    EXPECT_NE(alert->text.find(" until 20"), std::string::npos) << alert->text;
  }
  EXPECT_NE(twin.monitor.heldBack().find("pump, rotor are inhibited by the desk"),
            std::string::npos);
  twin.monitor.alerts().takeEvents();
  twin.time += 899.0;
  twin.tell(0.1e-3, 0.1);
  EXPECT_NE(twin.monitor.alerts().find("rotor", alert_type::kInhibited), nullptr);
  twin.time += 1.0;
  twin.tell(0.1e-3, 0.1);
  EXPECT_EQ(twin.monitor.alerts().find("rotor", alert_type::kInhibited), nullptr);
  EXPECT_EQ(twin.monitor.heldBack(), "");
  std::size_t ends = 0;
  for (const state::Alert& event : twin.monitor.alerts().takeEvents()) {
    ends += event.type == alert_type::kInhibited && !event.raised ? 1 : 0;
  }
  EXPECT_EQ(ends, 2u);
}

// A reset of the simulation clears alerts, and an inhibition continues: it is raised again.
TEST(AlarmCommands, AnInhibitionIsStillThereAfterAReset) {
  Commanded twin;
  twin.tell(0.1e-3, 0.4);
  twin.command(kInhibit, "rotor", "", 100.0);
  twin.monitor.alerts().clear("rotor", alert_type::kInhibited, 0.4, "the simulation was reset");
  twin.monitor.tick(twin.time, false);
  EXPECT_NE(twin.monitor.alerts().find("rotor", alert_type::kInhibited), nullptr);
  twin.command(kInhibit, "rotor");
  EXPECT_EQ(twin.monitor.alerts().find("rotor", alert_type::kInhibited), nullptr);
}

// ... nor does it outlive the monitor: one that comes back holds nothing back, and reports that.
TEST(AlarmCommands, AnInhibitionEndsWithItsMonitor) {
  Commanded before;
  before.tell(0.1e-3, 0.4);
  before.command(kInhibit, "rotor", "", 100.0);
  AlarmMemory memory;
  memory.alerts = before.monitor.alerts().active();
  memory.last_id = memory.alerts.back().id;
  Commanded after;
  after.monitor.remember(memory);
  EXPECT_EQ(after.monitor.alerts().find("rotor", alert_type::kInhibited), nullptr);
  EXPECT_FALSE(after.monitor.alerts().takeEvents().back().raised);
}

TEST(AlarmCommands, RefuseWhatCannotBeMeantAndDoNothingOfIt) {
  Commanded twin;
  twin.tell(2.0e-3, 0.4);
  const auto inputError = [&](const CommandAnswer& answer) {
    EXPECT_FALSE(answer.done);
    return answer.text;
  };
  EXPECT_EQ(inputError(twin.command(kAcknowledge, "roter")),
            "system: must be a system of the scene, found 'roter'; did you mean 'rotor'?");
  EXPECT_EQ(inputError(twin.command(kAcknowledge, "rotor", "UNSTABEL")),
            "type: must be a type of alert, found 'UNSTABEL'; did you mean 'UNSTABLE'?");
  EXPECT_EQ(inputError(twin.command(kAcknowledge, "rotor", "UNSTABLE")),
            "no active alert UNSTABLE of rotor");
  EXPECT_EQ(inputError(twin.command(kAcknowledge, "", "", 5.0)),
            "duration: must be 0 except for command 3 (inhibit), found 5");
  EXPECT_EQ(inputError(twin.command(kReset, "rotor")),
            "system: must be empty, since command 2 resets all alarms, found rotor");
  EXPECT_EQ(inputError(twin.command(kInhibit, "rotor", "UNSTABLE", 5.0)),
            "type: must be empty except for command 1 (acknowledge), found UNSTABLE");
  EXPECT_EQ(inputError(twin.command(kInhibit, "", "", 3601.0)),
            "duration: must be from 0 to 3600 s, found 3601");
  EXPECT_EQ(inputError(twin.command(kInhibit, "", "", std::numeric_limits<double>::quiet_NaN())),
            "duration: must be from 0 to 3600 s, found nan");
  EXPECT_EQ(inputError(twin.command(0)), "command: must be 1, 2 or 3, found 0");
  EXPECT_FALSE(twin.alertOf("rotor")->acknowledged);
  EXPECT_EQ(twin.monitor.status(twin.time, false).inhibited, (std::vector<double>{0.0, 0.0}));
}

}  // namespace alarm_commands_test
}  // namespace whirl_twin
