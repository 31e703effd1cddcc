// What commands say of a rotor beyond the speeds of its bearing tables, where the nearest row is
// held: it is marked. And the length and mass of a shaft whose elements are counted.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "twin_program.h"

namespace whirl_twin {
namespace table_speeds_test {

constexpr double kRpm = 3.14159265358979323846 / 30.0;

/// Two discs on a shaft in two bearings, tables from 100 to 900 rpm.
const std::string kTabulated = R"(
name: tabulated
step: 0.0005
drives:
  shaft: {speed: 20.0, profile: [{speed: 300.0, max_acceleration: 50.0}]}
systems:
  rotor:
    model: flexible_rotor
    drive: shaft
    parameters:
      youngs_modulus: 2.11e+11
      density: 7810.0
      elements: [{length: 0.25, outer_diameter: 0.05, count: 6}]
      discs:
        - {node: 2, mass: 32.6, polar_inertia: 0.33, transverse_inertia: 0.178}
        - {node: 4, mass: 35.8, polar_inertia: 0.40, transverse_inertia: 0.215}
      bearings: [{node: 0}, {node: 6}]
      bearing_tables:
        - {bearing: 0, speed: 100 rpm, kxx: 1.0e+6, cxx: 500.0}
        - {bearing: 0, speed: 500 rpm, kxx: 0.6e+6, cxx: 400.0}
        - {bearing: 0, speed: 900 rpm, kxx: 0.2e+6, cxx: 300.0}
        - {bearing: 1, speed: 100 rpm, kxx: 1.0e+6, cxx: 500.0}
        - {bearing: 1, speed: 500 rpm, kxx: 0.6e+6, cxx: 400.0}
        - {bearing: 1, speed: 900 rpm, kxx: 0.2e+6, cxx: 300.0}
      unbalances: [{node: 2, magnitude: 1.0e-3}]
)";

// The right values are of a dense solution with the coefficients at each speed.
TEST(TableSpeeds, MarkCriticalSpeedsBeyond) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", kTabulated);
  const auto rotor = twin({"campbell", scene, "--json"}).json()["systems"]["rotor"];
  EXPECT_NEAR(rotor["table_speeds"][1].get<double>(), 900.0 * kRpm, 1.0e-9);
  std::vector<double> within, beyond;
  for (const auto& one : rotor["crossings"]) {
    (one["beyond_tables"] ? beyond : within).push_back(one["speed"].get<double>() / kRpm);
  }
  ASSERT_EQ(within.size(), 2U);
  EXPECT_NEAR(within[0], 707.5, 0.05);
  EXPECT_NEAR(within[1], 708.3, 0.05);
  ASSERT_EQ(beyond.size(), 2U);
  EXPECT_NEAR(beyond[0], 1389.5, 0.05);
  EXPECT_NEAR(beyond[1], 1505.8, 0.05);
}

// Below the first row as above the last, in whatever looks at speeds.
TEST(TableSpeeds, MarkEveryResultBeyond) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", kTabulated);
  const std::vector<std::vector<std::string>> commands{{"campbell", scene},
                                                       {"response", scene},
                                                       {"orbit", scene, "--speed", "200"},
                                                       {"modes", scene, "--speed", "5"},
                                                       {"stability", scene, "--speed", "200"},
                                                       {"map", scene}};
  for (const std::vector<std::string>& command : commands) {
    const Ending end = twin(command);
    ASSERT_EQ(end.status, 0) << end.err;
    EXPECT_NE(end.out.find("beyond the tables"), std::string::npos) << command[0];
    std::vector<std::string> drawn = command;
    const std::string picture = folder.file(command[0] + ".svg");
    drawn.insert(drawn.end(), {"--plot", picture});
    ASSERT_EQ(twin(drawn).status, 0) << command[0];
  }
  const Ending analysis = twin({"analyze", scene, "--at", "6"});
  ASSERT_EQ(analysis.status, 0) << analysis.err;
  EXPECT_NE(analysis.out.find("beyond the tables"), std::string::npos);
  for (const char* speed : {"50", "200"}) {
    const Ending modes = twin({"modes", scene, "--speed", speed, "--json"});
    EXPECT_EQ(modes.json()["systems"]["rotor"]["beyond_tables"], std::string(speed) == "200");
  }
}

TEST(TableSpeeds, AreLeftByARunUpWithAWarning) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", kTabulated);
  const Ending check = twin({"check", scene});
  EXPECT_NE(check.out.find("warning       the shaft turns at 20 to 300 rad/s, in part beyond the "
                           "tables"),
            std::string::npos)
      << check.out;
  const std::string log = folder.file("run.lcmlog");
  const Ending run = twin({"simulate", scene, "--duration", "3", "--output", log});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("beyond its tables"), std::string::npos) << run.err;
  // Nothing is known of critical speeds there: none is an alarm.
  const auto alerts = twin({"monitor", scene, log, "--json"}).json()["alerts"];
  for (const auto& alert : alerts) {
    EXPECT_LT(alert["raised"].get<double>(), 1.485) << alert;
  }
  EXPECT_EQ(twin({"simulate", scene, "--duration", "1"}).err.find("beyond"), std::string::npos);
}

// 8 times 0.8 m of 50 mm steel: pi d^2 / 4 times length times density.
TEST(Check, TellsLengthAndMassOfACountedShaft) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", R"(
step: 0.0005
systems:
  rotor:
    model: flexible_rotor
    parameters:
      speed: 30.0
      youngs_modulus: 2.1e+11
      density: 7850.0
      elements: [{length: 0.8, outer_diameter: 0.05, count: 8}]
      bearings: [{node: 0, kxx: 1.0e+7}, {node: 8, kxx: 1.0e+7}]
)");
  const Ending end = twin({"check", scene, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto shaft = end.json()["systems"]["rotor"]["shaft"];
  EXPECT_NEAR(shaft["length"].get<double>(), 6.4, 1.0e-12);
  EXPECT_NEAR(shaft["mass"].get<double>(), kRpm * 30.0 * 0.05 * 0.05 / 4.0 * 6.4 * 7850.0, 1.0e-9);
  EXPECT_NE(twin({"check", scene}).out.find("6.4 m"), std::string::npos);
}

}  // namespace table_speeds_test
}  // namespace whirl_twin
