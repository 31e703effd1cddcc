// Commands about alarms by LCM and by topic, and settings changed by service, for a rotor that
// becomes unstable at a higher shaft speed.

#include <gtest/gtest.h>
#include <whirl_twin/AlarmCommand.h>
#include <whirl_twin/AlertArray.h>
#include <whirl_twin/MonitorStatus.h>
#include <whirl_twin/SetAlarmSettings.h>
#include <whirl_twin/SetSpeed.h>

#include <string>

#include "messages/commands.h"
#include "transport/channels.h"
#include "transport/lcm_publisher.h"
#include "waiting.h"

namespace whirl_twin {
namespace alarm_commands_test {

class AlarmCommandsTest : public ::testing::Test {
 protected:
  AlarmCommandsTest()
      : node_("/twin"),
        alerts_(node_.subscribe("alerts", 10, &AlarmCommandsTest::onAlerts, this)),
        status_(node_.subscribe("monitor", 10, &AlarmCommandsTest::onStatus, this)),
        topic_(node_.advertise<AlarmCommand>("alarm_commands", 10)),
        lcm_(kDefaultLcmUrl) {}

  void onAlerts(const AlertArray::ConstPtr& list) { list_ = list; }
  void onStatus(const MonitorStatus::ConstPtr& status) { newest_ = status; }

  const Alert* unstable() const {
    if (list_) {
      for (const Alert& alert : list_->alerts) {
        if (alert.type == "UNSTABLE") {
          return &alert;
        }
      }
    }
    return nullptr;
  }
  void runTo(double speed) {
    SetSpeed call;
    call.request.drive = "shaft";
    call.request.speed = speed;
    call.request.max_acceleration = 200.0;
    ASSERT_TRUE(ros::service::waitForService("/simulation_node/set_speed", 40000));
    ASSERT_TRUE(ros::service::call("/simulation_node/set_speed", call) && call.response.success);
  }
  void commandByLcm(int command, const std::string& system = "", double duration = 0.0) {
    state::AlarmCommand order;
    order.command = static_cast<std::uint8_t>(command);
    order.system = system;
    order.duration = duration;
    lcm_.publish(order);
  }
  static SetAlarmSettings::Response set(const std::string& settings) {
    SetAlarmSettings call;
    call.request.settings = settings;
    EXPECT_TRUE(ros::service::waitForService("/monitor_node/set_alarm_settings", 40000));
    EXPECT_TRUE(ros::service::call("/monitor_node/set_alarm_settings", call));
    return call.response;
  }

  ros::NodeHandle node_;
  ros::Subscriber alerts_, status_;
  ros::Publisher topic_;
  LcmPublisher lcm_;
  AlertArray::ConstPtr list_;
  MonitorStatus::ConstPtr newest_;
};

TEST_F(AlarmCommandsTest, AnAlertIsAcknowledgedResetAndHeldBackByLcmAndTopic) {
  ASSERT_TRUE(lcm_.on()) << lcm_.warning();
  ASSERT_TRUE(waitUntil([&] { return newest_ && topic_.getNumSubscribers() > 0; }));
  runTo(250.0);
  ASSERT_TRUE(waitUntil([&] { return unstable() != nullptr; }));
  ASSERT_FALSE(unstable()->acknowledged);
  commandByLcm(0);  // none that there is
  commandByLcm(state::AlarmCommand::kAcknowledge, "roter");
  commandByLcm(state::AlarmCommand::kAcknowledge, "rotor");
  ASSERT_TRUE(waitUntil([&] { return unstable() && unstable()->acknowledged; }));
  runTo(150.0);
  ASSERT_TRUE(waitUntil([&] { return unstable() && unstable()->latched; }));
  commandByLcm(state::AlarmCommand::kReset);
  ASSERT_TRUE(waitUntil([&] { return unstable() == nullptr; }));

  AlarmCommand hold;
  hold.command = AlarmCommand::INHIBIT;
  hold.system = "rotor";
  hold.duration = 4000.0;  // rejected: too long
  topic_.publish(hold);
  hold.duration = 600.0;
  topic_.publish(hold);
  ASSERT_TRUE(waitUntil([&] { return newest_->inhibited[0] > 500.0; }));
  runTo(250.0);
  commandByLcm(state::AlarmCommand::kInhibit, "rotor", 0.0);
  ASSERT_TRUE(waitUntil([&] { return unstable() != nullptr; }));
  runTo(150.0);
  ASSERT_TRUE(waitUntil([&] { return unstable() && unstable()->latched; }));
  commandByLcm(state::AlarmCommand::kReset);
  ASSERT_TRUE(waitUntil([&] { return unstable() == nullptr; }));
}

TEST_F(AlarmCommandsTest, SettingsChangeWholeOrNotAtAllAndTheParametersFollow) {
  const std::string before = set("").in_force;
  EXPECT_NE(before.find("latch: danger"), std::string::npos) << before;
  const SetAlarmSettings::Response refused =
      set("{latch: all, amplitude: {roter: {alert: 1.0e-3}}, lcm_url: none, hysteresis: 2}");
  EXPECT_FALSE(refused.success);
  EXPECT_EQ(refused.in_force, before);
  for (const char* wrong : {"amplitude.roter: unknown rotor", "lcm_url: unknown parameter",
                            "hysteresis: must be >= 0 and < 1"}) {
    EXPECT_NE(refused.message.find(wrong), std::string::npos) << refused.message;
  }
  // Where the rotor is unstable, without latching: the alert clears with its cause.
  const SetAlarmSettings::Response done = set("{latch: none, clear_delay: 0.2, amplitude: ~}");
  EXPECT_TRUE(done.success) << done.message;
  double delay = 0.0;
  std::string latch;
  EXPECT_TRUE(ros::param::get("/monitor_node/clear_delay", delay) && delay == 0.2);
  EXPECT_TRUE(ros::param::get("/monitor_node/latch", latch) && latch == "none");
  EXPECT_FALSE(ros::param::has("/monitor_node/amplitude"));
  runTo(250.0);
  ASSERT_TRUE(waitUntil([&] { return unstable() != nullptr; }));
  runTo(150.0);
  ASSERT_TRUE(waitUntil([&] { return unstable() == nullptr; }));
}

}  // namespace alarm_commands_test
}  // namespace whirl_twin
