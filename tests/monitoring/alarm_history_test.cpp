// The history of the alarms outlives the monitor: what was there is there, ids go on, what has gone
// meanwhile clears, and a file that cannot be written or read stops nothing.
#include "monitoring/alarm_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "watched_twin.h"

namespace whirl_twin {
namespace alarm_history_test {

constexpr char kGrowing[] = R"(
name: growing
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 10.0, speed: 250.0}
    initial: {x: 1.0e-9}
)";
constexpr char kCalm[] = R"(
name: calm
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, speed: 250.0}
)";

class AlarmHistoryTest : public testing::Test {
 protected:
  AlarmHistoryTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory_ =
        std::filesystem::temp_directory_path() / (std::string("alarm_history_") + test->name());
    std::filesystem::remove_all(directory_);
    path_ = directory_ / "alarms.jsonl";
  }
  ~AlarmHistoryTest() override { std::filesystem::remove_all(directory_); }

  /// A monitor that is killed with UNSTABLE raised, and its alert.
  state::Alert monitorThatDied() {
    WatchedTwin watched(sceneOf(kGrowing));
    watched.announce();
    watched.run(0.5);
    AlarmHistory history(path_);
    for (const state::Alert& event : watched.events) {
      history.write(event);
    }
    history.writeRun(watched.monitor.run().value());
    return watched.monitor.alerts().active().at(0);
  }

  std::filesystem::path directory_;
  std::filesystem::path path_;
};

TEST_F(AlarmHistoryTest, AnAlertComesBackAsItWas) {
  state::Alert alert;
  alert.id = 41;
  alert.type = "UNSTABLE";
  alert.system = "rotor";
  alert.severity = state::Severity::kDanger;
  alert.raised_time = 0.1;
  alert.time = 1.0 / 3.0;
  alert.speed = 250.25;
  alert.acknowledged = true;
  alert.repeats = 2;
  alert.text = R"(rotor: "grows" \ fast \u00e9)";
  {
    AlarmHistory history(path_);
    EXPECT_EQ(history.problem(), "");
    history.write(alert);
    history.writeRun({1'700'000'000'123'456'789, 3});
  }
  const AlarmHistory history(path_);
  ASSERT_EQ(history.memory().alerts.size(), 1u);
  const state::Alert& known = history.memory().alerts[0];
  EXPECT_EQ(known.id, 41u);
  EXPECT_EQ(known.type, alert.type);
  EXPECT_EQ(known.severity, alert.severity);
  EXPECT_EQ(known.time, alert.time);
  EXPECT_EQ(known.speed, alert.speed);
  EXPECT_TRUE(std::isnan(known.critical_speed));
  EXPECT_TRUE(known.acknowledged);
  EXPECT_FALSE(known.latched);
  EXPECT_EQ(known.text, alert.text);
  EXPECT_EQ(history.memory().last_id, 41u);
  EXPECT_EQ(history.memory().counts.at({"rotor", "UNSTABLE"}), 3u);
  EXPECT_EQ(history.memory().run->first, 1'700'000'000'123'456'789);
  EXPECT_EQ(history.memory().run->second, 3u);
}

TEST_F(AlarmHistoryTest, ALineThatIsTornIsLeftOutAndTheNextStandsApart) {
  state::Alert alert;
  alert.id = 1;
  alert.type = "UNSTABLE";
  alert.system = "rotor";
  AlarmHistory(path_).write(alert);
  std::ofstream(path_, std::ios::app) << R"({"event": "alert", "id": 2, "ty)";
  {
    AlarmHistory history(path_);
    EXPECT_EQ(history.unreadableLines(), 1u);
    alert.id = 3;
    history.write(alert);
  }
  const AlarmHistory history(path_);
  EXPECT_EQ(history.memory().last_id, 3u);
  EXPECT_EQ(history.memory().alerts.size(), 2u);
}

TEST_F(AlarmHistoryTest, ALongFileIsBegunAnewAndNothingIsForgotten) {
  state::Alert alert;
  alert.type = "UNSTABLE";
  alert.system = "rotor";
  {
    AlarmHistory history(path_);
    for (std::uint32_t id = 1; id <= 50; ++id) {
      alert.id = id;
      alert.repeats = id - 1;
      alert.raised = true;
      history.write(alert);
      alert.raised = false;
      history.write(alert);
    }
  }
  const AlarmHistory first(path_, 1000);
  EXPECT_LT(std::filesystem::file_size(path_), 1000u);
  EXPECT_GT(std::filesystem::file_size(path_.string() + ".old"), 1000u);
  const AlarmHistory second(path_, 1000);
  EXPECT_EQ(second.memory().last_id, 50u);
  EXPECT_EQ(second.memory().counts.at({"rotor", "UNSTABLE"}), 50u);
}

TEST_F(AlarmHistoryTest, AFileThatCannotBeWrittenIsSaid) {
  std::filesystem::create_directories(path_);  // a directory in its place
  AlarmHistory history(path_);
  EXPECT_NE(history.problem().find(path_.string()), std::string::npos) << history.problem();
  history.write(state::Alert{});
}

TEST_F(AlarmHistoryTest, AMonitorThatComesBackGoesOnWithItsAlert) {
  const state::Alert before = monitorThatDied();
  ASSERT_EQ(before.type, "UNSTABLE");
  WatchedTwin again(sceneOf(kGrowing));
  again.monitor.remember(AlarmHistory(path_).memory());
  ASSERT_EQ(again.monitor.alerts().active().size(), 1u) << "known before anything has come";
  again.announce();
  again.run(5.0);
  const auto active = again.monitor.alerts().active();
  ASSERT_EQ(active.size(), 1u);
  EXPECT_EQ(active[0].id, before.id);
  EXPECT_EQ(active[0].raised_time, before.raised_time);
  EXPECT_EQ(again.count("UNSTABLE", false), 0u);
}

TEST_F(AlarmHistoryTest, WhatHasGoneMeanwhileClearsAndTheNextIdIsNew) {
  const state::Alert before = monitorThatDied();
  WatchedTwin again(sceneOf(kCalm));
  again.monitor.remember(AlarmHistory(path_).memory());
  again.announce();
  again.run(1.0);
  EXPECT_EQ(again.monitor.alerts().active().size(), 1u) << "not known yet";
  again.run(3.0);
  EXPECT_TRUE(again.monitor.alerts().active().empty());
  ASSERT_EQ(again.events.size(), 1u);
  EXPECT_EQ(again.events[0].id, before.id);
  state::Alert next;
  next.system = "rotor";
  next.type = "UNSTABLE";
  again.monitor.alerts().raise(next, "");
  EXPECT_EQ(again.monitor.alerts().active().at(0).id, before.id + 1);
  EXPECT_EQ(again.monitor.alerts().active().at(0).repeats, 1u);
}

TEST_F(AlarmHistoryTest, ASimulationThatWasStartedAnewHasToSaySoTwice) {
  monitorThatDied();
  WatchedTwin again(sceneOf(kCalm));
  again.monitor.remember(AlarmHistory(path_).memory());
  again.loop.started += 1;
  again.announce();
  EXPECT_EQ(again.monitor.alerts().active().size(), 1u);
  again.announce();
  EXPECT_TRUE(again.monitor.alerts().active().empty());
}

}  // namespace alarm_history_test
}  // namespace whirl_twin
