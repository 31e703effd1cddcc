// Design analyses of a rotor: mode shapes, critical speed map, response to a non-rotating force.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "../scene/scenes.h"
#include "twin_program.h"

namespace whirl_twin {
namespace rotor_design_test {

using Json = nlohmann::json;

const std::string kFriswell = WHIRL_TWIN_SOURCE "/config/scenes/friswell_rotor.yaml";

Json rotorOf(const Ending& end) {
  EXPECT_EQ(end.status, 0) << end.err;
  return end.status == 0 ? end.json()["systems"]["rotor"] : Json();
}

std::complex<double> phasor(const Json& pair) {
  return {pair[0], pair[1]};
}

// Friswell et al., example 5.9.3: soft and stiff axes part each pair of modes; at rest all move in
// planes, and at speed the ellipses open, one way in one mode and the other way in the other.
TEST(Modes, HaveTheirKappaAtEveryNode) {
  const Json at_rest = rotorOf(twin({"modes", kFriswell, "--speed", "0", "--json"}));
  ASSERT_GE(at_rest["modes"].size(), 4u);
  for (std::size_t mode = 0; mode < 4; ++mode) {
    ASSERT_EQ(at_rest["modes"][mode]["shape"].size(), 7u);
    for (const Json& place : at_rest["modes"][mode]["shape"]) {
      EXPECT_NEAR(place["kappa"].get<double>(), 0.0, 1.0e-9);
    }
  }
  const Json turning = rotorOf(twin({"modes", kFriswell, "--speed", "300", "--json"}));
  for (std::size_t mode = 0; mode < 4; ++mode) {
    for (const Json& place : turning["modes"][mode]["shape"]) {
      const double kappa = place["kappa"];
      EXPECT_EQ(place["whirl"] == "forward", kappa > 0.0);
      EXPECT_NEAR(std::fabs(kappa), place["minor"].get<double>() / place["major"].get<double>(),
                  1.0e-12);
    }
  }
}

// The scene is stepped with some ten modes; its mode shapes are those of all 28 coordinates.
TEST(Modes, AreOfTheWholeShaft) {
  EXPECT_EQ(rotorOf(twin({"modes", kFriswell, "--speed", "100", "--json"}))["modes"].size(), 28u);
}

TEST(Modes, AreDrawnInFrontOfTheShaft) {
  const TemporaryDirectory folder;
  const std::string picture = folder.file("modes.json");
  const Ending end = twin({"modes", kFriswell, "--speed", "100", "--plot", picture, "--modes", "2",
                           "--csv", folder.file("modes.csv")});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_NE(end.out.find("kappa"), std::string::npos);
  EXPECT_NE(contentsOf(picture).find("whirl modes at 100 rad/s, 955 rpm"), std::string::npos);
  const Lines shapes = linesOf(contentsOf(folder.file("modes_shapes.csv")));
  EXPECT_EQ(shapes.size(), 1u + 28u * 7u);
  EXPECT_EQ(shapes.front(), "system,mode,station,position,major,minor,inclination,kappa,whirl");
}

TEST(Map, GoesFromTheRigidBodyToTheShaftBetweenPins) {
  const Json rotor = rotorOf(twin({"map", kFriswell, "--json"}));
  ASSERT_EQ(rotor["critical_speeds"].size(), 4u);
  EXPECT_EQ(rotor["bearings"].size(), 2u);
  EXPECT_EQ(rotor["bearings"][0]["kyy"][0], 0.8e6);
  const Json& first = rotor["critical_speeds"][0];
  const Json& k = rotor["stiffness"];
  // w^2 = 2 k / m, of the soft end, nearly; the pinned shaft, of the stiff one.
  const double mass =
      twin({"analyze", kFriswell, "--json"}).json()["systems"]["rotor"]["rotor"]["mass"];
  EXPECT_NEAR(first[0].get<double>() / std::sqrt(2.0 * k[0].get<double>() / mass), 1.0, 0.05);
  EXPECT_NEAR(first.back().get<double>() / rotor["on_rigid_bearings"][0].get<double>(), 1.0, 0.01);
  // Critical at 86.7 rad/s with 1e6 and 0.8e6 N/m: between the map's values for these.
  const Json at = rotorOf(
      twin({"map", kFriswell, "--from", "0.8e6", "--to", "1.0e6", "--points", "2", "--json"}));
  EXPECT_LT(at["critical_speeds"][0][0].get<double>(), 86.7);
  EXPECT_GT(at["critical_speeds"][0][1].get<double>(), 86.7);
}

// Fourteen nodes are held; the two that carry the rotor are varied, its seals are not.
TEST(Map, LeavesSealsOut) {
  const Json rotor = rotorOf(
      twin({"map", WHIRL_TWIN_SOURCE "/config/scenes/compressor.yaml", "--points", "5", "--json"}));
  ASSERT_EQ(rotor["bearings"].size(), 2u);
  EXPECT_EQ(rotor["bearings"][0]["node"], 6);
  EXPECT_EQ(rotor["bearings"][1]["node"], 52);
  EXPECT_EQ(rotor["left_out"].size(), 12u);
}

TEST(Map, IsOfFlexibleRotors) {
  const Ending end = twin({"map", kDemo});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.err,
            "twin: rotor (jeffcott_rotor): must be a flexible_rotor, the only model with bearings "
            "to vary\n");
  EXPECT_EQ(twin({"map", kFriswell, "--bearing", "0", "3"}).err,
            "twin: --bearing: expected nodes with bearings, 0, 6; found 3\n");
}

// 1 / (k - m W^2 + i W c), of the demo, m 2, k 7200, c 12; velocity i W of it.
TEST(Force, OnAJeffcottRotorMakesTheReceptanceOfAnOscillator) {
  const Json rotor = rotorOf(
      twin({"response", kDemo, "--force", "disc", "--speed", "40", "--to", "150", "--json"}));
  const Json& disc = rotor["stations"]["disc"];
  ASSERT_GT(rotor["frequencies"].size(), 200u);
  for (std::size_t i = 0; i < rotor["frequencies"].size(); ++i) {
    const double w = rotor["frequencies"][i];
    const std::complex<double> expected = 1.0 / std::complex<double>(3600.0 - w * w, 6.0 * w) / 2.0;
    EXPECT_LT(std::abs(phasor(disc["receptance"]["x"][i]) - expected), 1.0e-12);
    EXPECT_LT(std::abs(phasor(disc["mobility"]["x"][i]) - std::complex<double>(0.0, w) * expected),
              1.0e-10);
    EXPECT_EQ(std::abs(phasor(disc["receptance"]["y"][i])), 0.0);
  }
}

// Maxwell and Betti: force and place change parts. At speed the gyroscopic moments end that for
// x and y.
TEST(Force, AndPlaceChangePartsAtRest) {
  const auto across = [](const char* force, const char* at, const char* speed) {
    return rotorOf(twin({"response", kFriswell, "--force", force, "--at", at, "--speed", speed,
                         "--to", "300", "--points", "31", "--json"}))["stations"][at]["receptance"];
  };
  const Json there = across("node_2", "node_5", "0");
  const Json back = across("node_5", "node_2", "0");
  for (std::size_t i = 0; i < there["x"].size(); ++i) {
    const std::complex<double> z = phasor(there["x"][i]);
    EXPECT_LT(std::abs(z - phasor(back["x"][i])), 1.0e-9 * std::abs(z));
  }
  const Json turning = across("node_2", "node_5", "300");
  EXPECT_GT(std::abs(phasor(turning["y"][10])), 1.0e-3 * std::abs(phasor(turning["x"][10])));
}

// The scene under 2 N along y on node 5 at 130 rad/s, the shaft at 60 rad/s: its steady state
// agrees with the receptance.
TEST(Force, IsWhatTheSimulationComesTo) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("shaken.yaml", R"(
step: 0.0005
systems:
  rotor:
    model: flexible_rotor
    inputs: {force_y_3: {amplitude: 2.0, frequency: 130.0, phase: 0.0}}
    parameters:
      speed: 60.0
      youngs_modulus: 211.0e+9
      density: 7810.0
      elements: [{length: 0.25, outer_diameter: 0.05, count: 4}]
      discs: [{node: 1, mass: 30.0, polar_inertia: 0.6, transverse_inertia: 0.3}]
      bearings:
        - {node: 0, kxx: 1.0e+6, kyy: 0.8e+6, cxx: 3000.0}
        - {node: 4, kxx: 1.0e+6, kyy: 0.8e+6, cxx: 3000.0}
      modes: 0
)");
  const Json response =
      rotorOf(twin({"response", scene, "--force", "node_3", "--along", "y", "--at", "node_1",
                    "--from", "130", "--to", "131", "--points", "2", "--json"}));
  const std::complex<double> x = 2.0 * phasor(response["stations"]["node_1"]["receptance"]["x"][0]);
  const std::complex<double> y = 2.0 * phasor(response["stations"]["node_1"]["receptance"]["y"][0]);
  ASSERT_EQ(response["frequencies"][0], 130.0);
  const Json state = rotorOf(twin({"simulate", scene, "--duration", "8", "--json"}))["state"];
  const std::complex<double> turn = std::polar(1.0, 130.0 * 8.0);
  const double size = std::abs(x) + std::abs(y);
  EXPECT_NEAR(state["x_1"].get<double>(), (x * turn).real(), 1.0e-6 * size);
  EXPECT_NEAR(state["y_1"].get<double>(), (y * turn).real(), 1.0e-6 * size);
}

}  // namespace rotor_design_test
}  // namespace whirl_twin
