// Results of a rotor beyond the speeds of its bearing tables, where the nearest row is used: they
// are marked. And the length and mass of a shaft whose elements are counted.
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

// Below the first row as above the last, in every command with a speed.
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
    EXPECT_NE(end.out.find("outside the tables"), std::string::npos) << command[0];
    std::vector<std::string> drawn = command;
    const std::string picture = folder.file(command[0] + ".json");
    drawn.insert(drawn.end(), {"--plot", picture});
    ASSERT_EQ(twin(drawn).status, 0) << command[0];
  }
  const Ending analysis = twin({"analyze", scene, "--at", "6"});
  ASSERT_EQ(analysis.status, 0) << analysis.err;
  EXPECT_NE(analysis.out.find("outside the tables"), std::string::npos);
  for (const char* speed : {"50", "200"}) {
    const Ending modes = twin({"modes", scene, "--speed", speed, "--json"});
    EXPECT_EQ(modes.json()["systems"]["rotor"]["beyond_tables"], std::string(speed) == "200");
  }
}

TEST(TableSpeeds, AreLeftByARunUpWithAWarning) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", kTabulated);
  const Ending check = twin({"check", scene});
  EXPECT_NE(check.out.find("warning       the shaft turns at 20 to 300 rad/s, in part outside the "
                           "tables"),
            std::string::npos)
      << check.out;
  const std::string log = folder.file("run.lcmlog");
  const Ending run = twin({"simulate", scene, "--duration", "3", "--output", log});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("outside the tables"), std::string::npos) << run.err;
  // No critical speeds are known there: none raises an alarm.
  const auto alerts = twin({"monitor", scene, log, "--json"}).json()["alerts"];
  for (const auto& alert : alerts) {
    EXPECT_LT(alert["raised"].get<double>(), 1.485) << alert;
  }
  EXPECT_EQ(twin({"simulate", scene, "--duration", "1"}).err.find("beyond"), std::string::npos);
}

/// The same shaft in films of a clearance of 0.1 mm under half of its weight each.
std::string inFilms(const std::string& drive) {
  std::string scene = kTabulated.substr(0, kTabulated.find("      bearings:")) +
                      "      journal_bearings:\n"
                      "        - {node: 0, length: 0.02, diameter: 0.05, clearance: 1.0e-4, "
                      "viscosity: 0.02, load: 450.0}\n"
                      "        - {node: 6, length: 0.02, diameter: 0.05, clearance: 1.0e-4, "
                      "viscosity: 0.02, load: 450.0}\n"
                      "      unbalances: [{node: 2, magnitude: 1.0e-3}]\n";
  const auto from = scene.find("  shaft: {"), to = scene.find("systems:");
  return scene.replace(from, to - from, "  shaft: {" + drive + "}\n");
}

/// [rad/s], from Ocvirk's eccentricity e = 0.95: (1 - e^2)^4 = S^2 e^2 (pi^2 + (16 - pi^2) e^2),
/// S = D w mu L^3 / (8 load c^2).
double slowestInFilms() {
  const double pi = 30.0 * kRpm, e2 = 0.95 * 0.95;
  const double s = std::pow(1.0 - e2, 2) / std::sqrt(e2 * (pi * pi + (16.0 - pi * pi) * e2));
  return s * 8.0 * 450.0 * 1.0e-8 / (0.05 * 0.02 * 8.0e-6);
}

// Slower than a film carries its load the coefficients are held, at an eccentricity of 0.95.
TEST(FilmSpeeds, MarkResultsOfAShaftThatTouches) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", inFilms("speed: 200.0"));
  const std::string slow = std::to_string(0.5 * slowestInFilms());
  for (const std::string& speed : {slow, std::string("200")}) {
    const bool beyond = speed == slow;
    const auto json = twin({"modes", scene, "--speed", speed, "--json"}).json();
    EXPECT_EQ(json["systems"]["rotor"]["beyond_tables"], beyond) << speed;
    const Ending modes = twin({"modes", scene, "--speed", speed});
    EXPECT_EQ(modes.out.find("outside the film range") != std::string::npos, beyond) << modes.out;
  }
  const auto campbell =
      twin({"campbell", scene, "--to", "300", "--json"}).json()["systems"]["rotor"];
  EXPECT_NEAR(campbell["table_speeds"][0].get<double>(), slowestInFilms(), 1.0e-6);
  EXPECT_TRUE(campbell["table_speeds"][1].is_null());
  EXPECT_TRUE(campbell["beyond_tables"][0]);
  EXPECT_FALSE(campbell["beyond_tables"].back());
  EXPECT_EQ(twin({"campbell", scene, "--to", "300", "--plot", folder.file("c.json")}).status, 0);
  EXPECT_EQ(twin({"check", scene}).out.find("beyond"), std::string::npos);
}

TEST(FilmSpeeds, AreLeftWithAWarningWhereTheFilmsNeverCarry) {
  const TemporaryDirectory folder;
  const std::string speed = "speed: " + std::to_string(0.5 * slowestInFilms());
  const Ending slow = twin({"check", folder.write("slow.yaml", inFilms(speed))});
  EXPECT_NE(slow.out.find("outside the film range"), std::string::npos) << slow.out;
}

// A motor brings the shaft to the speed where its torque equals its drag, T = 8 - 0.02 w: 400
// rad/s, beyond the tables. Results there are marked.
TEST(TableSpeeds, AreLeftByAMotorWithAWarning) {
  const TemporaryDirectory folder;
  std::string text = kTabulated;
  const auto from = text.find("  shaft: {"), to = text.find("systems:");
  text.replace(from, to - from,
               "  shaft: {motor: {stall_torque: 8.0, no_load_speed: 400.0}, speed: 20.0}\n");
  const std::string scene = folder.write("scene.yaml", text);
  const Ending check = twin({"check", scene});
  EXPECT_NE(check.out.find("the motor can turn the shaft from 20 to 400 rad/s, in part outside the "
                           "tables"),
            std::string::npos)
      << check.out << check.err;
  bool any = false;
  const auto rotor = twin({"analyze", scene, "--json"}).json()["systems"]["rotor"];
  for (const auto& one : rotor["steady_speeds"]) {
    EXPECT_EQ(one["beyond_tables"], one["speed"].get<double>() > 900.0 * kRpm) << one;
    any = any || one["beyond_tables"];
  }
  EXPECT_TRUE(any);
}

// z'' + (c/m) z' + (k - i Q)/m z = 0, critically damped: nothing whirls without Q, and at
// Q_0 = c sqrt(k/m) the forward motion grows.
TEST(LevelOne, OfARotorThatWhirlsWithCrossCouplingOnly) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", R"(
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {speed: 100.0, mass: 2.0, stiffness: 20000.0, damping: 400.0}
)");
  const Ending text = twin({"stability", scene});
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("without cross-coupling all forward modes"), std::string::npos);
  const auto rotor = twin({"stability", scene, "--json"}).json()["systems"]["rotor"];
  EXPECT_NEAR(rotor["threshold_cross_coupling"].get<double>(), 4.0e4, 1.0);
  EXPECT_FALSE(rotor["forward_whirl_without_cross_coupling"]);
  EXPECT_GT(rotor["cross_coupling"][0].get<double>(), 0.0);
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
