// `twin campbell`, `twin response` and `twin orbit`: their output, drawings and
// errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "../scene/scenes.h"
#include "twin_program.h"

namespace whirl_twin {
namespace rotor_commands_test {

TEST(Campbell, FindsTheCriticalSpeedOfTheDemo) {
  const Ending end = twin({"campbell", kDemo, "--points", "20", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto rotor = end.json()["systems"]["rotor"];
  EXPECT_EQ(rotor["speeds"].size(), 20u);
  EXPECT_NEAR(rotor["speeds"].back().get<double>(), 1.2 * 90.0, 1e-9);
  ASSERT_EQ(rotor["branches"].size(), 2u);
  ASSERT_EQ(rotor["crossings"].size(), 2u);
  // zeta = 0.05: w = p sqrt(1 - zeta^2).
  for (const auto& crossing : rotor["crossings"]) {
    EXPECT_NEAR(crossing["speed"].get<double>(), 60.0 * std::sqrt(1.0 - 0.0025), 1e-9);
  }
  for (const auto& critical : rotor["undamped_critical_speeds"]) {
    EXPECT_NEAR(critical["speed"].get<double>(), 60.0, 1e-9);
  }
}

/// A disc of 4 kg overhung on a light shaft, as Stodola and Green had it: nothing damps it.
const std::string kUndamped = R"(
step: 0.0005
drives:
  shaft: {speed: 0.0, profile: [{speed: 300.0, max_acceleration: 30.0}]}
systems:
  overhung:
    model: rigid_disc_rotor
    drive: shaft
    parameters:
      mass: 4.0
      polar_inertia: 0.08
      transverse_inertia: 0.04
      overhung: {length: 0.25, bending_stiffness: 1000.0}
      eccentricity: 2.0e-5
)";

// Neither grows nor decays, at any speed: not by a rounding either.
TEST(Campbell, OfAnUndampedRotorHasNoDampingAtAll) {
  const TemporaryDirectory folder;
  const Ending end =
      twin({"campbell", folder.write("undamped.yaml", kUndamped), "--to", "600", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto rotor = end.json()["systems"]["overhung"];
  ASSERT_EQ(rotor["branches"].size(), 4u);
  for (const auto& branch : rotor["branches"]) {
    for (const char* margin : {"decay_rate", "damping_ratio", "log_decrement"}) {
      for (const auto& value : branch[margin]) {
        EXPECT_EQ(value.get<double>(), 0.0) << margin;
      }
    }
  }
  for (const auto& crossing : rotor["crossings"]) {
    EXPECT_EQ(crossing["log_decrement"].get<double>(), 0.0);
  }
}

struct StiffCase {
  std::string file;
  std::vector<double> speeds;  ///< rad/s
};
class StiffPins : public testing::TestWithParam<StiffCase> {};

// From the synchronous eigenproblem, K phi = w^2 (M - i G / w) phi, dense, pinned rows removed.
TEST_P(StiffPins, HaveTheSameCriticalSpeedsOnEveryGrid) {
  const std::string scene = std::string(WHIRL_TWIN_REFERENCE) + "/" + GetParam().file;
  for (const int to : {1000, 2000, 3000}) {
    std::vector<double> expected = GetParam().speeds;
    expected.erase(std::upper_bound(expected.begin(), expected.end(), to), expected.end());
    for (const char* points : {"50", "200", "333"}) {
      const Ending end =
          twin({"campbell", scene, "--to", std::to_string(to), "--points", points, "--json"});
      ASSERT_EQ(end.status, 0) << end.err;
      const auto found = end.json()["systems"]["rotor"]["crossings"];
      ASSERT_EQ(found.size(), expected.size()) << to << ' ' << points;
      int backward = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(found[i]["speed"].get<double>(), expected[i], 1.0e-5 * expected[i]);
        backward += found[i]["direction"] == "backward" ? 1 : 0;
      }
      EXPECT_EQ(2 * backward, static_cast<int>(expected.size()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Campbell, StiffPins,
    testing::Values(StiffCase{"stiff_pins_light_shaft.yaml", {565.789, 565.789}},
                    StiffCase{"stiff_pins_fine_mesh.yaml", {596.69, 597.72, 2369.35, 2385.47}}),
    [](const auto& one) { return one.param.file.substr(0, one.param.file.find('.')); });

// On rigid supports in the middle of a shaft without mass: 48 E I / l^3 and the disc.
TEST(Modes, OfADiscOnRigidPinsAreThoseOfTheShaftAlone) {
  const TemporaryDirectory folder;
  std::string scene =
      contentsOf(std::string(WHIRL_TWIN_REFERENCE) + "/stiff_pins_light_shaft.yaml");
  for (auto at = scene.find("1.0e+9"); at != std::string::npos; at = scene.find("1.0e+9")) {
    scene.replace(at, 6, "1.0e+20");
  }
  const Ending end = twin({"modes", folder.write("rigid.yaml", scene), "--speed", "500", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const double second_moment = 3.14159265358979323846 * std::pow(0.03, 4) / 64.0;
  const double frequency = std::sqrt(48.0 * 2.1e11 * second_moment / std::pow(0.5, 3) / 10.0);
  const auto modes = end.json()["systems"]["rotor"]["modes"];
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_NEAR(modes[i]["frequency"].get<double>(), frequency, 1.0e-5 * frequency);
  }
  EXPECT_NE(modes[0]["whirl"], modes[1]["whirl"]);
}

/// A shaft with a disc, reduced to a model valid up to 600 rad/s.
const std::string kReduced = R"(
step: 0.001
systems:
  rotor:
    model: flexible_rotor
    parameters:
      youngs_modulus: 2.0e11
      density: 7800.0
      highest_speed: 600.0
      elements: [{count: 8, length: 0.1, outer_diameter: 0.03}]
      discs: [{node: 3, mass: 8.0, polar_inertia: 0.04, transverse_inertia: 0.02}]
      bearings: [{node: 0, kxx: 1.0e7, kyy: 1.2e7, cxx: 300.0, cyy: 300.0}, {node: 8, kxx: 1.0e7, kyy: 1.2e7, cxx: 300.0, cyy: 300.0}]
      unbalances: [{node: 3, magnitude: 1.0e-4}]
      speed: 100.0
)";

TEST(Reduction, IsAskedForNoCriticalSpeedBeyondWhatItHoldsTo) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("reduced.yaml", kReduced);
  const Ending analysis = twin({"analyze", scene, "--json"});
  ASSERT_EQ(analysis.status, 0) << analysis.err;
  const auto rotor = analysis.json()["systems"]["rotor"];
  ASSERT_FALSE(rotor["critical_speeds"].empty());
  for (const auto& critical : rotor["critical_speeds"]) {
    EXPECT_LE(critical["speed"].get<double>(), 600.0);
  }
  const auto beyond = rotor["critical_speeds_beyond_reduction"].get<int>();
  EXPECT_GT(beyond, 0);
  EXPECT_NE(twin({"analyze", scene})
                .out.find(std::to_string(beyond) +
                          " more left out: the reduced-order rotor is valid only up to 600"),
            std::string::npos);

  const Ending diagram = twin({"campbell", scene, "--to", "20000", "--points", "20", "--json"});
  ASSERT_EQ(diagram.status, 0) << diagram.err;
  const auto shown = diagram.json()["systems"]["rotor"];
  EXPECT_EQ(shown["highest_speed"].get<double>(), 600.0);
  EXPECT_GT(shown["beyond_reduction"].get<int>(), 0);
  for (const char* list : {"crossings", "undamped_critical_speeds", "response_peaks"}) {
    EXPECT_FALSE(shown[list].empty()) << list;
    for (const auto& one : shown[list]) {
      EXPECT_LE(one["speed"].get<double>(), 600.0) << list;
    }
  }
}

TEST(Response, FindsThePeakOfTheDemo) {
  const Ending end = twin({"response", kDemo, "--points", "5", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto rotor = end.json()["systems"]["rotor"];
  ASSERT_EQ(rotor["peaks"].size(), 1u);
  EXPECT_NEAR(rotor["peaks"][0]["major"].get<double>(), 1e-4 / (0.1 * std::sqrt(1.0 - 0.0025)),
              1e-12);
  EXPECT_EQ(rotor["stations"]["disc"].size(), rotor["speeds"].size());
}

TEST(Orbit, OfTheDemoAtItsNaturalFrequencyLagsByAQuarter) {
  const Ending end = twin({"orbit", kDemo, "--speed", "60", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto disc = end.json()["systems"]["rotor"]["stations"]["disc"];
  EXPECT_NEAR(disc["major"].get<double>(), 1e-3, 1e-12);
  EXPECT_NEAR(disc["phase_lag"].get<double>(), std::acos(0.0), 1e-9);
  EXPECT_EQ(disc["direction"], "forward");
}

TEST(Figures, OfALongRotorShowItsOrbitsAlongTheShaftAndNoMoreStationsThanColours) {
  const TemporaryDirectory folder;
  const std::string scene = WHIRL_TWIN_SOURCE "/config/scenes/nelson_mcvaugh.yaml";
  const std::string orbits = folder.file("orbits.json");
  ASSERT_EQ(twin({"orbit", scene, "--speed", "300", "--plot", orbits}).status, 0);
  EXPECT_NE(contentsOf(orbits).find("along the shaft (m)"), std::string::npos);
  const std::string bode = folder.file("bode.json");
  ASSERT_EQ(twin({"response", scene, "--plot", bode}).status, 0);
  EXPECT_NE(contentsOf(bode).find("7 of 19 stations"), std::string::npos);
  EXPECT_NE(contentsOf(bode).find("semi-major axis (m) over shaft speed (rad/s)"),
            std::string::npos);
}

TEST(Figures, OfTheDemoHaveTheirLagsInDegrees) {
  const TemporaryDirectory folder;
  ASSERT_EQ(twin({"plot", kDemo, "--system", "rotor", "--duration", "12", "--format", "json",
                  "--output", folder.file("")})
                .status,
            0);
  const std::string history = contentsOf(folder.file("rotor_time.json"));
  EXPECT_NE(history.find("whirl phase lag (deg)"), std::string::npos);
  EXPECT_EQ(history.find("(rad)"), std::string::npos);
}

// A step that cannot be prepared matters only for stepping: only stepping commands reject the
// scene.
TEST(RotorCommands, NeedNoStep) {
  const TemporaryDirectory folder;
  const std::string scene =
      folder.write("scene.yaml", std::string(kUnsteppable) + "    integrator: exponential\n");
  for (const char* command : {"analyze", "campbell", "response"}) {
    const Ending end = twin({command, scene, "--json"});
    EXPECT_EQ(end.status, 0) << command << ": " << end.err;
    EXPECT_EQ(end.json()["systems"].size(), 1u) << command;
  }
  for (const char* command : {"check", "simulate"}) {
    const Ending end = twin({command, scene});
    EXPECT_EQ(end.status, 2) << command;
    EXPECT_NE(end.err.find("systems.rotor: "), std::string::npos) << end.err;
  }
}

TEST(RotorCommands, DrawPictures) {
  const TemporaryDirectory folder;
  const std::vector<std::vector<std::string>> commands{
      {"campbell"}, {"response"}, {"orbit", "--speed", "50"}};
  for (std::vector<std::string> command : commands) {
    const std::string picture = folder.file(command.front() + ".json");
    command.insert(command.begin() + 1, kDemo);
    command.insert(command.end(), {"--plot", picture});
    const Ending end = twin(command);
    EXPECT_EQ(end.status, 0) << end.err;
    EXPECT_EQ(nlohmann::json::parse(contentsOf(picture))["kind"], "charts");
  }
}

// Pedestals of 60 kg below the bearings of a shaft with an unbalance, as their accelerometers are
// on most machines. At 300 rad/s the one at node 0 moves 3.3426e-6 m, the shaft above it 4.5628e-6
// m (dense finite elements computed beside the program).
const std::string kOnPedestals = R"(
name: motion_of_pedestals
step: 0.0005
drives:
  shaft: {speed: 300.0}
systems:
  rotor:
    model: flexible_rotor
    drive: shaft
    parameters:
      youngs_modulus: 2.1e+11
      density: 7850.0
      elements: [{length: 0.2, outer_diameter: 0.06, count: 5}]
      discs: [{node: 2, mass: 25.0, polar_inertia: 0.30, transverse_inertia: 0.16}]
      bearings:
        - {node: 0, kxx: 4.0e+7, kyy: 3.0e+7, cxx: 2.0e+3}
        - {node: 5, kxx: 4.0e+7, kyy: 3.0e+7, cxx: 2.0e+3}
      pedestals:
        - {node: 0, mass: 60.0, kxx: 2.0e+7, kyy: 3.0e+7, cxx: 1.0e+3}
        - {node: 5, mass: 60.0, kxx: 2.0e+7, kyy: 3.0e+7, cxx: 1.0e+3}
      unbalances: [{node: 2, magnitude: 300 g mm}]
sensors:
  casing: {rate: 1000.0, channels: {left: {measures: rotor.pedestal_0.x, noise: 1.0e-9}}}
)";

TEST(Orbit, OfAPedestalIsThatOfTheCasing) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("pedestals.yaml", kOnPedestals);
  const Ending end = twin({"orbit", scene, "--speed", "300", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto stations = end.json()["systems"]["rotor"]["stations"];
  EXPECT_NEAR(stations["pedestal_0"]["major"].get<double>(), 3.3426e-6, 3e-9);
  EXPECT_NEAR(stations["node_0"]["major"].get<double>(), 4.5628e-6, 3e-9);
  const Ending response = twin({"response", scene, "--from", "299", "--to", "300", "--points", "2",
                                "--station", "pedestal_0", "--json"});
  ASSERT_EQ(response.status, 0) << response.err;
  const auto sweep = response.json()["systems"]["rotor"]["stations"];
  EXPECT_EQ(sweep.size(), 1U);
  EXPECT_NEAR(sweep["pedestal_0"].back()["major"].get<double>(),
              stations["pedestal_0"]["major"].get<double>(), 1e-12);
}

// After the start has died away a simulated run moves the pedestal as the orbit has it, in the
// table and at the sensor on it.
TEST(Orbit, OfAPedestalIsThatOfARun) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("pedestals.yaml", kOnPedestals);
  const Ending end =
      twin({"simulate", scene, "--duration", "16", "--output", folder.file("run.csv")});
  ASSERT_EQ(end.status, 0) << end.err;
  const Lines rows = linesOf(contentsOf(folder.file("run.csv")));
  std::vector<std::string> names;
  std::istringstream header(rows[0]);
  for (std::string name; std::getline(header, name, ',');) {
    names.push_back(name);
  }
  const auto column = std::find(names.begin(), names.end(), "rotor.pedestal_0.x") - names.begin();
  ASSERT_LT(column, static_cast<std::ptrdiff_t>(names.size()));
  double peak = 0.0;
  for (std::size_t row = rows.size() - 200; row < rows.size(); ++row) {
    std::istringstream fields(rows[row]);
    std::string field;
    for (std::ptrdiff_t i = 0; i <= column; ++i) {
      std::getline(fields, field, ',');
    }
    peak = std::max(peak, std::fabs(std::stod(field)));
  }
  const auto orbit = twin({"orbit", scene, "--speed", "300", "--json"})
                         .json()["systems"]["rotor"]["stations"]["pedestal_0"];
  const double amplitude = std::hypot(orbit["x"][0].get<double>(), orbit["x"][1].get<double>());
  EXPECT_NEAR(peak, amplitude, 2e-3 * amplitude);
}

struct RefusedCommand {
  std::vector<std::string> arguments;
  std::string message;
};
class RefusedRotorCommand : public testing::TestWithParam<RefusedCommand> {};

TEST_P(RefusedRotorCommand, SaysWhatWasExpected) {
  const Ending end = twin(GetParam().arguments);
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_EQ(end.err, "twin: " + GetParam().message + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    RotorCommands, RefusedRotorCommand,
    testing::Values(
        RefusedCommand{{"campbell", kDemo, "--system", "pendulum"},
                       "--system: expected a linear rotor on a shaft of prescribed speed, found "
                       "pendulum (spinning_pendulum)"},
        RefusedCommand{{"campbell", kDemo, "--from", "50", "--to", "20"},
                       "--from, --to: --from must be < --to, found 50 and 20 rad/s"},
        RefusedCommand{{"campbell", kDemo, "--from", "-1"},
                       "--from: must be a shaft speed from 0 to 1e+06 rad/s, found -1"},
        RefusedCommand{{"response", kDemo, "--points", "1"},
                       "--points: expected from 2 to 10000, found 1"},
        RefusedCommand{{"response", kDemo, "--plot", "bode.gif"},
                       "--plot: expected a name that ends in .svg, .png, .pdf or .json, found "
                       "'bode.gif'"},
        RefusedCommand{{"response", kDemo, "--station", "disk"},
                       "--station: no station 'disk' on rotor (jeffcott_rotor); did you mean "
                       "'disc'?"},
        RefusedCommand{{"orbit", kDemo, "--speed", "-3"},
                       "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found -3"}));

}  // namespace rotor_commands_test
}  // namespace whirl_twin
