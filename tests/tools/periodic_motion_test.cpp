// Systems with alternating loads, in analysis and monitoring commands. The reference values for the
// oscillating pivot come from an independent integration (scipy's DOP853) of Mathieu's equation;
// the product of all multipliers is Liouville's, e^(-integral of the damping).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "twin_program.h"

namespace whirl_twin {
namespace periodic_motion_test {

using Json = nlohmann::json;

constexpr double kPi = 3.14159265358979323846;

std::string caseOf(const std::string& name) {
  return WHIRL_TWIN_SOURCE "/tests/reference/pendulums/" + name + ".yaml";
}

Json analysed(const std::string& path, const std::string& system = "p") {
  const Ending end = twin({"analyze", path, "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  return end.json()["systems"][system];
}

/// That of the equilibrium at an angle.
Json equilibriumAt(const Json& system, double theta) {
  for (const Json& e : system["equilibria"]) {
    if (std::fabs(e["state"]["theta"].get<double>() - theta) < 1.0e-6) {
      return e;
    }
  }
  ADD_FAILURE() << "no equilibrium at " << theta;
  return {};
}

TEST(PeriodicMotion, AHangingPendulumShakenAtTwiceItsFrequencyIsUnstable) {
  const Json p = analysed(caseOf("hanging"));
  EXPECT_EQ(p["routh"]["verdict"], "unstable");
  EXPECT_EQ(p["judged_about"], "periodic_motion");
  EXPECT_NEAR(p["margins"]["decay_rate"].get<double>(), -0.12703, 1.0e-5);
  EXPECT_NEAR(p["periodic_motion"]["multipliers"][0][0].get<double>(), -1.09429, 1.0e-5);
  EXPECT_EQ(p["linearization"]["about"]["theta"], 0.0);
}

TEST(PeriodicMotion, UprightThePendulumIsJudgedBetweenItsExactThresholdAndThatOfTheMean) {
  const Json falls = analysed(caseOf("upright"));
  EXPECT_EQ(falls["routh"]["verdict"], "unstable");
  EXPECT_EQ(equilibriumAt(falls, kPi)["verdict"], "unstable");
  const Json stands = analysed(caseOf("upright_stands"));
  EXPECT_EQ(stands["routh"]["verdict"], "asymptotically_stable");
  // The frequency by which it would be lost is that of Mathieu's equation.
  const Json& numbers = stands["parameter_margins"]["parameters"];
  const auto frequency = std::find_if(numbers.begin(), numbers.end(), [](const Json& number) {
    return number["parameter"] == "frequency";
  });
  ASSERT_NE(frequency, numbers.end()) << numbers;
  EXPECT_NEAR((*frequency)["lost_at"].get<double>(), 47.55646, 1.0e-2);
}

TEST(PeriodicMotion, TheMonitorRaisesUnstableWhileTheShakenPendulumGrows) {
  const TemporaryDirectory folder;
  const std::string log = folder.file("run.lcmlog");
  ASSERT_EQ(twin({"simulate", caseOf("hanging"), "--duration", "30", "--output", log}).status, 0);
  const Ending monitored = twin({"monitor", caseOf("hanging"), log, "--json"});
  ASSERT_EQ(monitored.status, 0) << monitored.err;
  const Json alerts = monitored.json()["alerts"];
  EXPECT_TRUE(std::any_of(alerts.begin(), alerts.end(), [](const Json& alert) {
    return alert["type"] == "UNSTABLE" && alert["severity"] == "danger";
  })) << alerts;
}

TEST(PeriodicMotion, AHarmonicInputIsJudgedAboutTheMotionThatItDrives) {
  const TemporaryDirectory folder;
  const std::string scene =
      "name: driven\nstep: 0.001\nsystems:\n  p:\n    model: pendulum\n"
      "    parameters: {mass: 1.0, length: 0.5, damping: 0.05}\n"
      "    inputs: {torque: {amplitude: 1.0, frequency: 3.141592653589793, phase: 0.4}}\n";
  const Json p = analysed(folder.write("driven.yaml", scene));
  EXPECT_EQ(p["judged_about"], "periodic_motion");
  EXPECT_EQ(p["routh"]["verdict"], "asymptotically_stable");
  EXPECT_NEAR(p["periodic_motion"]["period"].get<double>(), 2.0, 1.0e-12);
  std::complex<double> product = 1.0;
  for (const Json& multiplier : p["periodic_motion"]["multipliers"]) {
    product *= std::complex<double>(multiplier[0], multiplier[1]);
  }
  const double rate = 0.05 / (1.0 * 0.5 * 0.5);
  EXPECT_NEAR(product.real(), std::exp(-rate * 2.0), 1.0e-9);
  // A run settles on the motion that was found.
  const Ending run = twin({"simulate", folder.file("driven.yaml"), "--duration", "200", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json settled = run.json()["systems"]["p"]["state"];
  for (const char* name : {"theta", "theta_rate"}) {
    EXPECT_NEAR(settled[name].get<double>(), p["periodic_motion"]["state"][name].get<double>(),
                1.0e-6);
  }
}

TEST(PeriodicMotion, WhatOnlyTheMeanCanTellIsLabelledSo) {
  const Json rotor = analysed(WHIRL_TWIN_SOURCE "/config/scenes/oil_whip.yaml", "rotor");
  EXPECT_EQ(rotor["judged_about"], "mean_motion");
  const Ending text = twin({"analyze", WHIRL_TWIN_SOURCE "/config/scenes/oil_whip.yaml"});
  EXPECT_NE(text.out.find("under mean loads"), std::string::npos);
}

}  // namespace periodic_motion_test
}  // namespace whirl_twin
