// The history of the alarms survives the monitor: alarms and ids are restored, causes that have
// ended meanwhile clear, and a file that cannot be written or read stops nothing.
#include "monitoring/alarm_history.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

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

TEST_F(AlarmHistoryTest, AnEventHasTheWallClockBesideSimulatedTime) {
  state::Alert alert;
  alert.id = 1;
  alert.type = "UNSTABLE";
  alert.system = "rotor";
  alert.time = 12.5;
  alert.stamp = 1'772'373'792'345'678'901;  // as `date -u -d @1772373792` has it
  AlarmHistory(path_).write(alert);
  std::ifstream file(path_);
  std::string line;
  std::getline(file, line);
  EXPECT_NE(line.find(R"("wall": "2026-03-01T14:03:12.345Z")"), std::string::npos) << line;
  EXPECT_NE(line.find(R"("stamp": 1772373792345678901)"), std::string::npos) << line;
  EXPECT_NE(line.find(R"("time": 12.5)"), std::string::npos) << line;
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

state::Alert alertOf(std::uint32_t id, const std::string& type, bool raised) {
  state::Alert alert;
  alert.id = id;
  alert.system = "rotor";
  alert.type = type;
  alert.raised = raised;
  return alert;
}

std::vector<std::uint32_t> idsIn(const AlarmHistory& history) {
  std::vector<std::uint32_t> ids;
  for (const state::Alert& alert : history.memory().alerts) {
    ids.push_back(alert.id);
  }
  return ids;
}

TEST_F(AlarmHistoryTest, AChangedDigitIsALineLeftOut) {
  AlarmHistory(path_).write(alertOf(7, "UNSTABLE", true));
  std::string line;
  std::getline(std::ifstream(path_), line);
  for (std::size_t at = 0; at + 1 < line.size(); ++at) {
    std::string other = line;
    other[at] = static_cast<char>(other[at] ^ 1);
    std::ofstream(path_) << other << "\n";
    const AlarmHistory history(path_);
    // But in the word "crc32c": a line of an earlier version has none.
    EXPECT_TRUE(history.unreadableLines() == 1 || idsIn(history) == std::vector{7U}) << other;
  }
  std::ofstream(path_) << R"({"event": "id", "id": 12})"
                       << "\n";  // of an earlier version
  EXPECT_EQ(AlarmHistory(path_).memory().last_id, 12U);
}

// A limit of the size of files stands for the disk that is full.
TEST_F(AlarmHistoryTest, AfterAFullDiskEverythingThatIsActiveIsWritten) {
  AlarmHistory history(path_);
  history.write(alertOf(1, "UNSTABLE", true));
  history.write(alertOf(2, "LOW_DAMPING", true));
  const auto full = std::filesystem::file_size(path_) + 100;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limited{full, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &limited);
  history.write(alertOf(2, "LOW_DAMPING", false));
  history.write(alertOf(3, "ROUTH_DISAGREES", true));
  history.write(alertOf(4, "AMPLITUDE", true));
  history.write(alertOf(4, "AMPLITUDE", false));
  EXPECT_NE(history.problem().find("File too large"), std::string::npos) << history.problem();
  EXPECT_EQ(idsIn(AlarmHistory(path_)), (std::vector{1U, 2U})) << "no torn line";
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  history.retry();
  EXPECT_EQ(history.problem(), "");
  const AlarmHistory read(path_);
  EXPECT_EQ(idsIn(read), (std::vector{1U, 3U}));
  EXPECT_EQ(read.memory().last_id, 4U);
  EXPECT_EQ(read.memory().counts.at({"rotor", "AMPLITUDE"}), 1U);
  EXPECT_EQ(read.unreadableLines(), 0U);
}

TEST_F(AlarmHistoryTest, AFileThatWasRemovedOrReplacedHasAllThatIsActive) {
  AlarmHistory history(path_);
  history.write(alertOf(1, "UNSTABLE", true));
  std::filesystem::remove(path_);
  history.write(alertOf(2, "LOW_DAMPING", true));
  EXPECT_EQ(idsIn(AlarmHistory(path_)), (std::vector{1U, 2U}));
  // Another disk, on which an alarm is that has been cleared since.
  const std::string other = path_.string() + ".other";
  AlarmHistory(other).write(alertOf(1, "UNSTABLE", true));
  history.write(alertOf(1, "UNSTABLE", false));
  std::filesystem::rename(other, path_);
  history.retry();
  EXPECT_EQ(idsIn(AlarmHistory(path_)), std::vector{2U});
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
