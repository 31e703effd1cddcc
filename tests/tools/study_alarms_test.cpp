// The alarms counted by a study are those that the monitor raises for the same run's log.
#include <gtest/gtest.h>

#include <utility>

#include "swept_study.h"

namespace whirl_twin {
namespace study_alarms_test {

/// It runs up through its critical speed.
std::string sceneOf(const std::string& damping) {
  std::string scene = kStudiedRotor;
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"damping: 10.0", "damping: " + damping},
        {"speed: 90.0", "speed: 0.0, profile: [{speed: 150.0, max_acceleration: 25.0}]"}}) {
    scene.replace(scene.find(from), from.size(), to);
  }
  return scene;
}

TEST(StudyAlarms, AreThoseOfTheMonitor) {
  const TemporaryDirectory files;
  files.write("scene.yaml", sceneOf("10.0"));
  const std::string settings =
      files.write("monitor.yaml", "amplitude: {rotor: {alert: 4.0e-4, danger: 8.0e-4}}\n");
  const std::string study = files.write("study.yaml", R"(
study: {scene: scene.yaml}
vary: {rotor.damping: {list: [5.0, 40.0]}}
design: list
run: {duration: 8.0, alarms: monitor.yaml}
measure:
  all: alarms
  band: alarms.IN_CRITICAL_BAND
  wide: alarms.WHIRL_AMPLITUDE
)");
  double most = 0.0;
  for (const std::string point : {"0", "1"}) {
    const Ending counted = twin({"sweep", study, "--point", point, "--json"});
    ASSERT_EQ(counted.status, 0) << counted.err;
    const std::string scene = files.write("one.yaml", sceneOf(point == "0" ? "5.0" : "40.0"));
    const std::string log = files.file("log" + point + ".lcmlog");
    ASSERT_EQ(twin({"simulate", scene, "--duration", "8", "--output", log}).status, 0);
    const nlohmann::json report =
        twin({"monitor", scene, log, "--settings", settings, "--json"}).json();
    std::map<std::string, double> raised;
    for (const auto& alert : report["alerts"]) {
      ++raised[alert["type"].get<std::string>()];
    }
    const nlohmann::json measures = counted.json()["measures"];
    EXPECT_EQ(measures["all"], static_cast<double>(report["alerts"].size())) << report["alerts"];
    EXPECT_EQ(measures["band"], raised["IN_CRITICAL_BAND"]);
    EXPECT_EQ(measures["wide"], raised["WHIRL_AMPLITUDE"]);
    most = std::max(most, measures["all"].get<double>());
    if (point == "0") {  // lightly damped it passes a band that it has, and is wide there
      EXPECT_EQ(measures["band"], 1.0);
      EXPECT_EQ(measures["wide"], 1.0);
    }
  }
  EXPECT_GT(most, 1.0);
}

}  // namespace study_alarms_test
}  // namespace whirl_twin
