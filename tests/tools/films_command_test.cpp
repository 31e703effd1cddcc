// Rotors in equilibrium in oil films at half the clearance and more, and rotors above their whip
// threshold, in analysis and monitoring commands. The reference values come from independent
// computations outside this project: dense finite elements, numerical quadrature of Ocvirk's film,
// Newton's method.
#include <gtest/gtest.h>

#include <cmath>

#include "twin_program.h"

namespace whirl_twin {
namespace films_command_test {

using Json = nlohmann::json;

constexpr double kTolerance = 1.0e-3;

std::string caseOf(const std::string& name) {
  return WHIRL_TWIN_SOURCE "/tests/tools/films/" + name + ".yaml";
}

Json analysed(const std::string& path) {
  const Ending end = twin({"analyze", path, "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  return end.json()["systems"]["rotor"];
}

/// The case with another text at one place.
Json analysedWith(const std::string& name, const std::string& old, const std::string& now) {
  const TemporaryDirectory folder;
  std::string scene = contentsOf(caseOf(name));
  const std::size_t at = scene.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return analysed(folder.write("case.yaml", scene.replace(at, old.size(), now)));
}

void expectNear(const Json& value, double right) {
  ASSERT_TRUE(value.is_number()) << value;
  EXPECT_NEAR(value.get<double>(), right, kTolerance * std::fabs(right));
}

/// [m], where a journal is about which the rotor is linearized.
double eccentricity(const Json& rotor, const std::string& node) {
  const Json& about = rotor["linearization"]["about"];
  return std::hypot(about["x_" + node].get<double>(), about["y_" + node].get<double>());
}

TEST(Films, AFlexibleRotorRestsBeyondHalfTheClearance) {
  const Json rotor = analysed(caseOf("films_at_rest"));
  const Json& about = rotor["linearization"]["about"];
  for (const char* node : {"0", "8"}) {
    EXPECT_NEAR(about[std::string("x_") + node].get<double>(), 16.9e-6, 0.05e-6);
    EXPECT_NEAR(about[std::string("y_") + node].get<double>(), -14.4e-6, 0.05e-6);
    EXPECT_NEAR(eccentricity(rotor, node), 0.555 * 4.0e-5, kTolerance * 4.0e-5);
  }
  EXPECT_EQ(rotor["routh"]["verdict"], "asymptotically_stable");
  expectNear(rotor["margins"]["decay_rate"], 2.455);
  expectNear(rotor["margins"]["instability_speed"], 425.0);
}

TEST(Films, TheMonitorOfARotorThatComesToRestDoesNotCallItUnstable) {
  const TemporaryDirectory folder;
  const std::string log = folder.file("r.lcmlog");
  const Ending simulated =
      twin({"simulate", caseOf("films_at_rest"), "--duration", "2", "--output", log});
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const Ending monitored = twin({"monitor", caseOf("films_at_rest"), log, "--json"});
  ASSERT_EQ(monitored.status, 0) << monitored.err;
  // Its lowest log decrement is below 0.1 and a critical speed is near: that much is true of it.
  for (const Json& alert : monitored.json()["alerts"]) {
    EXPECT_TRUE(alert["type"] == "LOW_DAMPING" || alert["type"] == "IN_CRITICAL_BAND") << alert;
  }
}

TEST(Films, AboveItsThresholdARotorIsLinearizedAboutItsEquilibrium) {
  const Json rotor = analysed(caseOf("whip_above_threshold"));
  expectNear(rotor["margins"]["instability_speed"], 1491.8);
  expectNear(rotor["margins"]["decay_rate"], -69.56);
  double fastest = 0.0;
  double frequency = 0.0;
  for (const Json& root : rotor["eigenvalues"]) {
    if (root[0].get<double>() > fastest) {
      fastest = root[0].get<double>();
      frequency = std::fabs(root[1].get<double>());
    }
  }
  EXPECT_NEAR(frequency, 875.6, kTolerance * 875.6);
}

TEST(Films, TheEquilibriumIsTheSameWithoutUnbalanceAndWithHardlyAny) {
  for (const char* name : {"films", "films_with_unbalance"}) {
    const Json rotor = analysed(caseOf(name));
    EXPECT_NEAR(eccentricity(rotor, "0"), 0.555 * 1.1e-4, kTolerance * 1.1e-4) << name;
    expectNear(rotor["margins"]["decay_rate"], 105.79);
    expectNear(rotor["margins"]["instability_speed"], 744.8);
  }
}

TEST(Films, AboveTheThresholdTheGrowthRateIsThatAboutTheUnstableEquilibrium) {
  for (const char* name : {"films", "films_with_unbalance"}) {
    const Json rotor = analysedWith(name, "speed: 300.0", "speed: 900.0");
    expectNear(rotor["margins"]["decay_rate"], -29.97);
    expectNear(rotor["margins"]["instability_speed"], 744.8);
  }
}

// At standstill no film carries a load: the verdict is unknown, and reported as such.
TEST(Films, WithoutAnEquilibriumTheVerdictIsUncertain) {
  const TemporaryDirectory folder;
  std::string scene = contentsOf(caseOf("films"));
  scene.replace(scene.find("speed: 300.0"), 12, "speed: 0.0");
  const std::string path = folder.write("still.yaml", scene);
  const Json rotor = analysed(path);
  EXPECT_EQ(rotor["routh"]["verdict"], "uncertain");
  EXPECT_EQ(rotor["uncertain_because"], "no equilibrium was found at this speed");
  EXPECT_TRUE(rotor["sag"].is_null());
  EXPECT_TRUE(rotor["margins"]["decay_rate"].is_null());
  EXPECT_TRUE(rotor["margins"]["instability_speed"].is_null());
  EXPECT_NE(twin({"analyze", path}).out.find("no equilibrium was found"), std::string::npos);
}

// The journals hang 14.4 um low, and the shaft between them sags as a beam in pins under the weight
// of the disc in its middle and its own, by bending and by shear (Timoshenko; Cowper's 0.886).
TEST(Films, TheSagIsReportedApartFromTheVibration) {
  const std::string path = caseOf("films_at_rest");
  const Json rotor = analysed(path);
  const double length = 0.8;
  const double area = 0.25 * M_PI * 9.0e-4;
  const double bending = 2.1e11 * M_PI * 8.1e-7 / 64.0;
  const double shear = 0.886 * area * 2.1e11 / 2.6;
  const double disc = 12.0 * 9.80665;
  const double shaft = 7850.0 * area * length * 9.80665;
  const double sag = (disc / 48.0 + 5.0 * shaft / 384.0) * std::pow(length, 3) / bending +
                     (disc / 4.0 + shaft / 8.0) * length / shear + 14.4e-6;
  EXPECT_EQ(rotor["sag"]["station"], "node_4");
  EXPECT_NEAR(rotor["sag"]["y"].get<double>(), -sag, 1.0e-7);
  EXPECT_TRUE(rotor["uncertain_because"].is_null());
  const Ending check = twin({"check", path, "--json"});
  ASSERT_EQ(check.status, 0) << check.err;
  const Json checked = check.json()["systems"]["rotor"];
  EXPECT_EQ(checked["starts_at_equilibrium"], true);
  EXPECT_EQ(checked["sag"], rotor["sag"]);
  EXPECT_NE(twin({"check", path}).out.find("at its equilibrium, sag 0.0002"), std::string::npos);
}

TEST(Films, TheShippedOilWhipGrowsAsAboutItsEquilibrium) {
  const Ending end = twin(
      {"analyze", WHIRL_TWIN_SOURCE "/config/scenes/oil_whip.yaml", "--speed", "350", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  expectNear(end.json()["systems"]["rotor"]["margins"]["decay_rate"], -1.1275);
}

}  // namespace films_command_test
}  // namespace whirl_twin
