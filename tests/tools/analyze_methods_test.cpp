// The methods of the lecture notes in `twin analyze`, and warnings of `twin simulate` where a
// model's equations cease to be valid.
#include <gtest/gtest.h>

#include <cmath>

#include "twin_program.h"

namespace whirl_twin {
namespace analyze_methods_test {

using Json = nlohmann::json;

Json analysisOf(const std::string& scene, const std::string& system) {
  const Ending end = twin({"analyze", scene, "--system", system, "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  return end.json()["systems"][system];
}

// Three masses on a lever: the notes' numbers, Dunkerley < exact < Rayleigh < assumed modes.
TEST(AnalyzeMethods, TheLeversBoundsStandInTheirOrder) {
  const Json lever = analysisOf("linear_system", "lever")["methods"];
  EXPECT_EQ(lever["stiffness_form"], "positive definite");
  const double a[3][3] = {{2, -3, -3}, {-3, 9, 9}, {-3, 9, 10}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(lever["influence_coefficients"][i][j].get<double>(), a[i][j], 1e-12);
    }
  }
  const Json bounds = lever["lowest_frequency"];
  const double dunkerley = bounds["dunkerley_lower"];
  const double exact = bounds["exact"];
  const double rayleigh = bounds["rayleigh_upper"];
  const Json assumed = analysisOf("linear_system", "assumed");
  const double ritz = assumed["natural_frequencies"][0];
  EXPECT_NEAR(dunkerley, 0.2182178902, 1e-9);
  EXPECT_NEAR(exact, 0.2262270211, 1e-9);
  EXPECT_NEAR(ritz, 0.3271300494, 1e-7);
  EXPECT_LT(dunkerley, exact);
  const double ritz_of_two = bounds["ritz_upper"];
  EXPECT_LT(exact, ritz_of_two);
  EXPECT_LT(ritz_of_two, rayleigh);
  EXPECT_LT(rayleigh, ritz);
  EXPECT_NEAR(bounds["matrix_iteration"]["frequency"].get<double>(), exact, 1e-9);
  EXPECT_EQ(assumed["methods"]["undamped_natural_frequencies"].size(), 2u);
}

TEST(AnalyzeMethods, AFreeBarHasRigidBodyModesAndNoLowerBound) {
  const Json bar = analysisOf("linear_system", "submarine");
  EXPECT_EQ(bar["methods"]["rigid_body_modes"].size(), 2u);
  EXPECT_TRUE(bar["methods"]["influence_coefficients"].is_null());
  EXPECT_TRUE(bar["methods"]["lowest_frequency"]["dunkerley_lower"].is_null());
  EXPECT_NE(
      bar["methods"]["lowest_frequency"]["dunkerley_refusal"].get<std::string>().find("rigid"),
      std::string::npos);
  EXPECT_EQ(bar["reduced"]["rigid_body_modes"], 2);
  EXPECT_EQ(bar["reduced"]["routh"]["verdict"], "marginal");
  EXPECT_EQ(bar["routh"]["imaginary"], 6) << "of all coordinates, zeros included";
  ASSERT_EQ(bar["natural_frequencies"].size(), 1u);
  EXPECT_NEAR(bar["natural_frequencies"][0].get<double>(), std::sqrt(100.0 * 6.0), 1e-9);
}

TEST(AnalyzeMethods, ACyclicCoordinateIsNamedWithItsMomentumAndTheSteadyMotions) {
  const Json wheel = analysisOf("sliding_mass_flywheel", "symmetric");
  EXPECT_EQ(wheel["reduced"]["cyclic"], Json::array({"phi"}));
  EXPECT_NEAR(wheel["reduced"]["momenta"]["phi"].get<double>(),
              (0.05 + 2.0 * 0.3 * 0.32 * 0.32) * 15.0, 1e-12);
  const Json motion = wheel["equilibria"][0];
  const double w = motion["steady_rates"]["phi"];
  EXPECT_NEAR(motion["state"]["rho"].get<double>(), 200.0 * 0.2 / (200.0 - 0.3 * w * w), 1e-10);
  EXPECT_EQ(motion["verdict"], "marginal");
  EXPECT_EQ(wheel["linearization"]["about"]["phi_rate"], w);
}

// (M/3) th'' + c th' + (k/4) th = f/2 cos(15 t): amplitude (f/2) / |k/4 - M W^2/3 + i c W|.
TEST(AnalyzeMethods, TheSteadyResponseToTheScenesLoadIsTheClosedForm) {
  const Json response = analysisOf("hinged_beam", "small")["methods"]["steady_response"][0];
  EXPECT_EQ(response["frequency"], 15.0);
  const double stiff = 1000.0 - 4.0 * 225.0;
  const double loss = 6.0 * 15.0;
  EXPECT_NEAR(response["amplitude"]["theta"].get<double>(), 50.0 / std::hypot(stiff, loss), 1e-9);
  EXPECT_NEAR(response["lag"]["theta"].get<double>(), std::atan2(loss, stiff), 1e-9);
}

TEST(AnalyzeMethods, ReactionsConditionsAndRouthsConditionsAreListed) {
  const Json pendulum = analysisOf("double_pendulum", "absolute")["methods"];
  EXPECT_EQ(pendulum["reactions"]["rod_tension_1"]["unit"], "N");
  const Json engine = analysisOf("governor", "engine")["methods"]["routh_conditions"];
  ASSERT_EQ(engine.size(), 4u) << "A0, A1, A2 > 0 and A1 A2 > A0: a real cubic";
  EXPECT_EQ(engine[3]["condition"], "A1 A2 > A0");
  EXPECT_EQ(engine[3]["holds"], true);
  EXPECT_GT(analysisOf("rod_slider", "rod")["methods"]["conditions"]["rod_end"]["margin"], 0.0);
}

// P dx + 2 m g dh: 2 P l cos(theta) - m g l sin(theta).
TEST(AnalyzeMethods, TheVirtualWorkOfTheTwoBarsVanishesAtTheirRest) {
  const Json bars = analysisOf("two_bar_linkage", "bars");
  const double theta = bars["state"]["theta"];
  EXPECT_NEAR(bars["methods"]["virtual_work"]["theta"].get<double>(),
              20.0 * std::cos(theta) - 2.0 * 9.81 * std::sin(theta), 1e-12);
}

TEST(SimulateWarns, WhenAModelsEquationsStopToHold) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write(
      "off.yaml",
      "step: 0.001\nsystems:\n  rod:\n    model: rod_slider\n    parameters: {slider_mass: 1, "
      "rod_mass: 0.5, rod_length: 0.8, stiffness: 60, free_length: 0.5}\n    initial: {r: 0.7, "
      "r_rate: 2}\n");
  const Ending end = twin({"simulate", scene, "--duration", "2", "--json"});
  EXPECT_EQ(end.status, 0) << "the run goes on";
  const Json invalid = end.json()["systems"]["rod"]["invalid"];
  ASSERT_EQ(invalid.size(), 1u);
  EXPECT_EQ(invalid[0]["condition"], "rod_end");
  EXPECT_LT(invalid[0]["worst_margin"], 0.0);
  EXPECT_NEAR(invalid[0]["first_time"].get<double>(), 0.05, 0.01) << "0.1 m at 2 m/s";
  const Lines lines = linesOf(end.err);
  ASSERT_EQ(lines.size(), 1u) << "once, not in every step: " << end.err;
  EXPECT_NE(lines[0].find("rod: warning: from t = 0.05"), std::string::npos) << lines[0];
}

TEST(CheckRefuses, AStartWithoutInertiaGivingThePhysicalReason) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write(
      "pole.yaml",
      "step: 0.001\nsystems:\n  p: {model: rotating_pendulum, parameters: {mass: 1, length: 0.5, "
      "hub_inertia: 0}}\n");
  const Ending end = twin({"check", scene});
  EXPECT_EQ(end.status, 2);
  EXPECT_NE(end.err.find("systems.p.initial: the mass matrix is singular here: "),
            std::string::npos)
      << end.err;
}

}  // namespace analyze_methods_test
}  // namespace whirl_twin
