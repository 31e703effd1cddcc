// `twin analyze` against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <set>

#include "twin_program.h"

namespace whirl_twin {
namespace analyze_command_test {

using Json = nlohmann::json;

std::set<std::string> keys(const Json& object) {
  std::set<std::string> all;
  for (const auto& [key, value] : object.items()) {
    all.insert(key);
  }
  return all;
}

/// The analysis of the only system, `it`, of a scene.
Json analyzed(const std::string& system, const std::string& scene = "") {
  const TemporaryDirectory directory;
  const Ending end = twin({"analyze", "--json",
                           directory.write("scene.yaml", "step: 0.001\n" + scene +
                                                             "systems:\n  it: " + system + "\n")});
  EXPECT_EQ(end.status, 0) << end.err;
  return end.json()["systems"]["it"];
}

TEST(Analyze, HasEveryKey) {
  const Ending end = twin({"analyze", kDemo, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(keys(end.json()["systems"]), (std::set<std::string>{"rotor", "pendulum"}));
  const nlohmann::json systems = end.json()["systems"];
  for (const auto& [name, system] : systems.items()) {
    EXPECT_EQ(keys(system), (std::set<std::string>{"model",
                                                   "coordinates",
                                                   "time",
                                                   "speed",
                                                   "state",
                                                   "acceleration",
                                                   "energy",
                                                   "equilibria",
                                                   "linearization",
                                                   "eigenvalues",
                                                   "omitted",
                                                   "judged_about",
                                                   "periodic_motion",
                                                   "uncertain_because",
                                                   "sag",
                                                   "dry_friction",
                                                   "beyond_tables",
                                                   "table_speeds",
                                                   "natural_frequencies",
                                                   "damping_ratios",
                                                   "characteristic_polynomial",
                                                   "routh",
                                                   "margins",
                                                   "critical_speeds",
                                                   "critical_speeds_beyond_reduction",
                                                   "critical_speeds_searched_to",
                                                   "cross_coupling_margin",
                                                   "parameter_margins",
                                                   "spread_margin",
                                                   "steady_speeds",
                                                   "methods"}));
    EXPECT_EQ(keys(system["energy"]), (std::set<std::string>{"kinetic", "potential", "jacobi",
                                                             "dissipated_power", "input_power"}));
    EXPECT_EQ(keys(system["equilibria"][0]),
              (std::set<std::string>{"state", "verdict", "decay_rate"}));
    EXPECT_EQ(keys(system["linearization"]),
              (std::set<std::string>{"about", "mass", "damping", "gyroscopic", "stiffness",
                                     "circulatory"}));
    EXPECT_EQ(keys(system["routh"]),
              (std::set<std::string>{"verdict", "right", "imaginary", "left", "first_column"}));
    EXPECT_EQ(keys(system["margins"]),
              (std::set<std::string>{"decay_rate", "damping_ratio", "log_decrement",
                                     "log_decrement_amplitude", "log_decrement_coordinate",
                                     "instability_speed"}));
  }
  EXPECT_EQ(
      keys(end.json()["systems"]["rotor"]["critical_speeds"][0]),
      (std::set<std::string>{"speed", "direction", "amplification_factor", "separation_margin",
                             "required_separation_margin", "beyond_tables"}));
}

// m = 2 kg, k = 5000 N/m, c = 10 N s/m: p = 50 rad/s, zeta = c / (2 m p) = 0.05.
class DampedRotor : public testing::Test {
 protected:
  static constexpr double kP = 50.0;
  static constexpr double kZeta = 0.05;
  const Json rotor_ = analyzed(
      "{model: jeffcott_rotor, parameters: {mass: 2, stiffness: 5000, damping: 10, speed: 80,"
      " eccentricity: 1e-4}, initial: {x: 1e-3, y_rate: 0.02}}");
};

TEST_F(DampedRotor, FrequencyAndDamping) {
  for (int mode : {0, 1}) {
    EXPECT_NEAR(rotor_["natural_frequencies"][mode], kP, 1e-13 * kP);
    EXPECT_NEAR(rotor_["damping_ratios"][mode], kZeta, 1e-14);
  }
  ASSERT_EQ(rotor_["eigenvalues"].size(), 4u);
  for (const Json& root : rotor_["eigenvalues"]) {
    EXPECT_NEAR(root[0], -kZeta * kP, 1e-12);
    EXPECT_NEAR(std::fabs(root[1].get<double>()), kP * std::sqrt(1.0 - kZeta * kZeta), 1e-12);
  }
  EXPECT_NEAR(rotor_["margins"]["decay_rate"], kZeta * kP, 1e-12);
  EXPECT_NEAR(rotor_["margins"]["damping_ratio"], kZeta, 1e-14);
  EXPECT_NEAR(rotor_["margins"]["log_decrement"],
              2.0 * M_PI * kZeta / std::sqrt(1.0 - kZeta * kZeta), 1e-12);
  EXPECT_TRUE(rotor_["margins"]["log_decrement_amplitude"].is_null()) << "any: it is linear";
  EXPECT_EQ(rotor_["margins"]["log_decrement_coordinate"], "whirl");
  EXPECT_TRUE(rotor_["margins"]["instability_speed"].is_null());
  EXPECT_EQ(rotor_["routh"]["verdict"], "asymptotically_stable");
  EXPECT_EQ(rotor_["routh"]["left"], 4);
  // (s^2 + 5 s + 2500)^2, exact.
  EXPECT_EQ(rotor_["characteristic_polynomial"], Json({1.0, 10.0, 5025.0, 25000.0, 6250000.0}));
}

// The unbalance response of a Jeffcott rotor peaks at p / sqrt(1 - 2 zeta^2), in forward whirl.
TEST_F(DampedRotor, CriticalSpeedAndItsMargin) {
  ASSERT_EQ(rotor_["critical_speeds"].size(), 1u);
  const Json& critical = rotor_["critical_speeds"][0];
  const double speed = kP / std::sqrt(1.0 - 2.0 * kZeta * kZeta);
  EXPECT_NEAR(critical["speed"], speed, 1e-9 * speed);
  EXPECT_EQ(critical["direction"], "forward");
  const double factor = critical["amplification_factor"];
  EXPECT_NEAR(factor, 1.0 / (2.0 * kZeta), 0.02 / (2.0 * kZeta));  // light damping: 1 / 2 zeta
  EXPECT_NEAR(critical["separation_margin"], 100.0 * (80.0 - speed) / 80.0, 1e-6);
  EXPECT_NEAR(critical["required_separation_margin"], 17.0 * (1.0 - 1.0 / (factor - 1.5)), 1e-9);
}

// e = 1e-4 m turning at 80 rad/s: at angle 0 the mass centre adds e w^2 to x'' and e w to its y'.
TEST_F(DampedRotor, StateAccelerationAndEnergyAtTheStart) {
  EXPECT_EQ(rotor_["model"], "jeffcott_rotor");
  EXPECT_EQ(rotor_["coordinates"], Json({"x", "y"}));
  EXPECT_EQ(rotor_["speed"], 80.0);
  EXPECT_EQ(rotor_["state"], Json({{"x", 1e-3}, {"y", 0.0}, {"x_rate", 0.0}, {"y_rate", 0.02}}));
  EXPECT_NEAR(rotor_["acceleration"]["x"], -2500.0 * 1e-3 + 1e-4 * 6400.0, 1e-13);
  EXPECT_NEAR(rotor_["acceleration"]["y"], -5.0 * 0.02, 1e-14);
  const double speed_of_centre = 0.02 + 1e-4 * 80.0;
  EXPECT_NEAR(rotor_["energy"]["kinetic"], speed_of_centre * speed_of_centre, 1e-17);
  EXPECT_NEAR(rotor_["energy"]["potential"], 0.5 * 5000.0 * 1e-6, 1e-17);
  EXPECT_NEAR(rotor_["energy"]["dissipated_power"], 10.0 * 0.02 * 0.02, 1e-17);
}

TEST_F(DampedRotor, LinearizationRowByRow) {
  EXPECT_EQ(rotor_["linearization"]["about"],
            Json({{"x", 0.0}, {"y", 0.0}, {"x_rate", 0.0}, {"y_rate", 0.0}}));
  EXPECT_EQ(rotor_["linearization"]["mass"], Json({{2.0, 0.0}, {0.0, 2.0}}));
  EXPECT_EQ(rotor_["linearization"]["damping"], Json({{10.0, 0.0}, {0.0, 10.0}}));
  EXPECT_EQ(rotor_["linearization"]["stiffness"], Json({{5000.0, 0.0}, {0.0, 5000.0}}));
}

// Kimball: internal damping c_i makes a rotor unstable above p (1 + c / c_i).
TEST(Analyze, InternalDampingSetsTheInstabilitySpeed) {
  const Json rotor = analyzed(
      "{model: jeffcott_rotor, parameters: {mass: 2, stiffness: 5000, damping: 10,"
      " internal_damping: 5, speed: 40}}");
  EXPECT_NEAR(rotor["margins"]["instability_speed"], 50.0 * (1.0 + 10.0 / 5.0), 1e-10);
  // Circulatory: N = [[0, c_i w], [-c_i w, 0]].
  EXPECT_EQ(rotor["linearization"]["circulatory"], Json({{0.0, 200.0}, {-200.0, 0.0}}));
}

// The same at 75 rad/s, p = 50: lost by damping at c_i (w / p - 1), by stiffness where p = 25.
TEST(Analyze, TellsTheNumberNearestToTheLossOfStability) {
  const Json rotor = analyzed(
      "{model: jeffcott_rotor, parameters: {mass: 2, stiffness: 5000, damping: 10,"
      " internal_damping: 5, speed: 75}}");
  const Json& margins = rotor["parameter_margins"];
  EXPECT_EQ(margins["resolution"], 0.05);
  EXPECT_EQ(margins["reach"], 10.0);
  std::map<std::string, Json> of;
  for (const Json& margin : margins["parameters"]) {
    of[margin["parameter"]] = margin;
  }
  EXPECT_NEAR(of.at("speed")["lost_at"], 150.0, 1.0e-6);
  EXPECT_NEAR(of.at("speed")["change"], 1.0, 1.0e-8);
  EXPECT_EQ(of.at("speed")["loss"], "whirl");
  EXPECT_NEAR(of.at("speed")["frequency"], 50.0, 1.0e-4);
  EXPECT_NEAR(of.at("damping")["lost_at"], 2.5, 1.0e-7);
  EXPECT_NEAR(of.at("cross_coupling")["lost_at"], 15.0 * 50.0 - 5.0 * 75.0, 1.0e-5);
  EXPECT_TRUE(of.at("cross_coupling")["change"].is_null());
  EXPECT_NEAR(of.at("stiffness")["lost_at"], 5000.0 / 4.0, 1.0e-4);
  EXPECT_NEAR(of.at("mass")["change"], 3.0, 1.0e-7);
  EXPECT_NEAR(margins["parameters"][0]["change"], -0.75, 1.0e-8) << "nearest first";
  const Json growing = analyzed(
      "{model: jeffcott_rotor, parameters: {mass: 2, stiffness: 5000, damping: 10,"
      " internal_damping: 5, speed: 160}}");
  EXPECT_TRUE(growing["parameter_margins"].is_null()) << "it has lost it already";
}

// Lost at 20 N s/m of internal damping: by a quarter of those from 14 to 22.
TEST(Analyze, TellsWhatASpreadOfItsNumbersDoes) {
  const Json rotor = analyzed(
      "{model: jeffcott_rotor, parameters: {mass: 1, stiffness: 10000, damping: 10,"
      " internal_damping: 18, speed: 150}, spread: {internal_damping: {half_width: 4}}}");
  EXPECT_EQ(rotor["spread_margin"]["members"], 1000);
  EXPECT_NEAR(rotor["spread_margin"]["growing"].get<double>(), 250.0, 55.0);
  EXPECT_LT(rotor["spread_margin"]["lowest_decay_rate"].get<double>(), 0.0);
  EXPECT_EQ(rotor["spread_margin"]["stable_throughout"], false);
  EXPECT_TRUE(
      analyzed("{model: jeffcott_rotor, parameters: {mass: 1, stiffness: 10000, damping: 10,"
               " internal_damping: 18, speed: 150}}")["spread_margin"]
          .is_null());
}

TEST(Analyze, UndampedCriticalSpeedHasNoAmplificationFactor) {
  const Json rotor =
      analyzed("{model: jeffcott_rotor, parameters: {mass: 1, stiffness: 100, speed: 0}}");
  const Json& critical = rotor["critical_speeds"][0];
  EXPECT_NEAR(critical["speed"], 10.0, 1e-9);
  EXPECT_TRUE(critical["amplification_factor"].is_null());
  EXPECT_TRUE(critical["separation_margin"].is_null()) << "at standstill there is none";
  EXPECT_EQ(critical["required_separation_margin"], 26.0);
  EXPECT_EQ(rotor["routh"]["verdict"], "marginal");
}

// A spinning pendulum faster than sqrt(g/l) has equilibria at cos theta = g / (l w^2) on either
// side.
TEST(Analyze, SpinningPendulumFliesOutwards) {
  const double speed = 10.0;
  const Json pendulum = analyzed(
      "{model: spinning_pendulum, parameters: {mass: 0.5, length: 0.4, damping: 0.01, speed: 10},"
      " initial: {theta: 0.3}}");
  const double theta = std::acos(9.80665 / (0.4 * speed * speed));
  const Json& equilibria = pendulum["equilibria"];
  ASSERT_EQ(equilibria.size(), 4u);
  const double expected[] = {-theta, 0.0, theta, M_PI};
  const char* verdicts[] = {"asymptotically_stable", "unstable", "asymptotically_stable",
                            "unstable"};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(equilibria[i]["state"]["theta"], expected[i], 1e-14);
    EXPECT_EQ(equilibria[i]["verdict"], verdicts[i]);
  }
  EXPECT_NEAR(pendulum["linearization"]["about"]["theta"], theta, 1e-14);
  EXPECT_EQ(pendulum["linearization"]["about"]["theta_rate"], 0.0);
  // About it, theta'' + w^2 sin^2(theta) theta = 0.
  EXPECT_NEAR(pendulum["natural_frequencies"][0], speed * std::sin(theta), 1e-12);
  EXPECT_TRUE(pendulum["critical_speeds"].empty());
}

// Equal masses and rods: w^2 = (2 -+ sqrt 2) g / l.
TEST(Analyze, DoublePendulumFrequencies) {
  const Json pendulum = analyzed(
      "{model: double_pendulum, parameters: {mass1: 1.5, mass2: 1.5, length1: 0.7, length2: 0.7},"
      " initial: {theta1: 0.1}}");
  const double square = 9.80665 / 0.7;
  EXPECT_NEAR(pendulum["natural_frequencies"][0], std::sqrt((2.0 - std::sqrt(2.0)) * square),
              1e-13);
  EXPECT_NEAR(pendulum["natural_frequencies"][1], std::sqrt((2.0 + std::sqrt(2.0)) * square),
              1e-13);
  EXPECT_EQ(pendulum["equilibria"].size(), 4u);
  EXPECT_EQ(pendulum["routh"]["verdict"], "marginal");
  EXPECT_EQ(pendulum["margins"]["decay_rate"], 0.0);
  EXPECT_TRUE(pendulum["speed"].is_null());
  EXPECT_TRUE(pendulum["margins"]["instability_speed"].is_null());
}

// A rotor above its threshold speed has no stable equilibrium and is linearized where it is.
TEST(Analyze, WithoutAStableEquilibriumTheInitialStateIsLinearizedAbout) {
  const Json rotor = analyzed(
      "{model: jeffcott_rotor, parameters: {mass: 1, stiffness: 100, damping: 1,"
      " internal_damping: 1, speed: 30}, initial: {x: 0.01, y_rate: 0.2}}");
  EXPECT_EQ(rotor["linearization"]["about"], rotor["state"]);
  EXPECT_EQ(rotor["routh"]["verdict"], "unstable");
  EXPECT_LT(rotor["margins"]["decay_rate"], 0.0);
}

// On a drive the analysis is at its start: speed and acceleration of the shaft.
TEST(Analyze, ARotorWithWeightRestsWhereItSags) {
  const Json rotor = analyzed(
      "{model: jeffcott_rotor, parameters: {mass: 2, stiffness: 20000, damping: 20, "
      "gravity_on_shaft: true, speed: 50}}");
  ASSERT_EQ(rotor["equilibria"].size(), 1u);
  EXPECT_NEAR(rotor["equilibria"][0]["state"]["y"], -9.80665e-4, 1e-15);
  EXPECT_NEAR(rotor["linearization"]["about"]["y"], -9.80665e-4, 1e-15);
}

// Its bearings carry nothing along y: the rotor falls, as twin simulate shows, and is not stable.
TEST(Analyze, AWeightThatNothingCarriesIsNoStableMotion) {
  const std::string shaft =
      "{model: flexible_rotor, parameters: {youngs_modulus: 2.1e+11, density: 7850, speed: 100, "
      "gravity_on_shaft: true, elements: [{length: 0.1, outer_diameter: 0.05, count: 8}], discs: "
      "[{node: 4, mass: 15, polar_inertia: 0.1, transverse_inertia: 0.06}], bearings: [{node: 0, "
      "kxx: 1e+7, kyy: KYY, cxx: 100, cyy: 100}, {node: 8, kxx: 1e+7, kyy: KYY, cxx: 100, "
      "cyy: 100}]}}";
  const auto carried = [&](const std::string& kyy) {
    return analyzed(std::regex_replace(shaft, std::regex("KYY"), kyy));
  };
  const Json falls = carried("0.0");
  EXPECT_TRUE(falls["equilibria"].empty());
  EXPECT_EQ(falls["routh"]["verdict"], "uncertain");
  EXPECT_NE(falls["uncertain_because"].get<std::string>().find("a constant load acts along"),
            std::string::npos);
  EXPECT_EQ(carried("1e+6")["routh"]["verdict"], "asymptotically_stable");
}

TEST(Analyze, AShaftWithoutBearingsNeitherRestsNorIsUnstable) {
  const std::string shaft =
      "{model: flexible_rotor, parameters: {youngs_modulus: 2.0e+11, density: 7800, speed: 1000, "
      "elements: [{length: 0.25, outer_diameter: 0.05, count: 4}], "
      "discs: [{node: 2, mass: 10, polar_inertia: 0.1, transverse_inertia: 0.06}], modes: 0";
  const Json floating = analyzed(shaft + "}}");
  EXPECT_EQ(floating["reduced"]["routh"]["verdict"], "marginal");
  EXPECT_EQ(floating["reduced"]["rigid_body_modes"], 4);
  EXPECT_EQ(floating["routh"]["verdict"], "repeated_imaginary");  // it drifts
  EXPECT_EQ(floating["routh"]["right"], 0);
  EXPECT_TRUE(floating["margins"]["instability_speed"].is_null());
  EXPECT_TRUE(analyzed(shaft + ", gravity_on_shaft: true}}")["equilibria"].empty());
}

// c p: what takes all damping of the forward whirl of a round rotor.
TEST(Analyze, TheCrossCouplingMarginOfAJeffcottRotorIsItsDampingTimesItsFrequency) {
  const Json rotor = analyzed(
      "{model: jeffcott_rotor, parameters: {mass: 2, stiffness: 20000, damping: 20, speed: 50}}");
  EXPECT_EQ(rotor["cross_coupling_margin"]["station"], "disc");
  EXPECT_NEAR(rotor["cross_coupling_margin"]["stiffness"], 20.0 * 100.0, 1e-6);
  EXPECT_TRUE(rotor["steady_speeds"].empty());
}

TEST(Analyze, ARotorOnAWeakMotorHasThreeSteadySpeeds) {
  const Ending end =
      twin({"analyze", WHIRL_TWIN_SOURCE "/config/scenes/sommerfeld.yaml", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json captured = end.json()["systems"]["captured"]["steady_speeds"];
  ASSERT_EQ(captured.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    // Torque of the motor, and of the whirl of an isotropic rotor: c w r^2.
    const double w = captured[i]["speed"];
    const double x = w / 200.0;
    const double r = 2e-4 * x * x / std::hypot(1.0 - x * x, 2.0 * 0.02 * x);
    EXPECT_NEAR(0.3 * (1.0 - w / 400.0), 40.0 * w * r * r, 1e-9);
    EXPECT_EQ(captured[i]["stable"], i != 1);
  }
  EXPECT_NEAR(captured[0]["speed"], 197.9, 0.05);
  EXPECT_EQ(end.json()["systems"]["escaping"]["steady_speeds"].size(), 1u);
  EXPECT_TRUE(end.json()["systems"]["captured"]["cross_coupling_margin"].is_null());
}

// The demo's rotor is still where it starts, at 4 rad/s: at 60 rad/s it is too near its critical
// speed, and that is what --speed specifies.
TEST(Analyze, OfASpeedIsThatOfAShaftHeldThere) {
  const Json held = twin({"analyze", kDemo, "--system", "rotor", "--speed", "62", "--json"}).json();
  EXPECT_EQ(held["systems"]["rotor"]["speed"], 62.0);
  const Json& critical = held["systems"]["rotor"]["critical_speeds"][0];
  EXPECT_LT(critical["separation_margin"], critical["required_separation_margin"]);

  // sqrt(w^2 - g/R) and so on: the spinning pendulum's own frequency at a speed below sqrt(g/l).
  const Json pendulum =
      twin({"analyze", kDemo, "--system", "pendulum", "--speed", "5", "--json"}).json();
  const double frequency = pendulum["systems"]["pendulum"]["natural_frequencies"][0];
  EXPECT_NEAR(frequency, std::sqrt(9.80665 / 0.2032 - 25.0), 1e-6);

  EXPECT_EQ(twin({"analyze", "rod_slider", "--speed", "5"}).err,
            "twin: --speed: needs a system with a shaft, found none\n");
  EXPECT_EQ(twin({"analyze", "sommerfeld", "--speed", "5"}).status, 2);
}

TEST(Analyze, OfAMomentIsThatOfTheMotionThen) {
  const Json run = twin({"simulate", kDemo, "--duration", "9", "--json"}).json();
  const Json then = twin({"analyze", kDemo, "--at", "9", "--json"}).json();
  for (const char* system : {"rotor", "pendulum"}) {
    EXPECT_EQ(then["systems"][system]["state"], run["systems"][system]["state"]) << system;
    EXPECT_EQ(then["systems"][system]["time"], 9.0);
    EXPECT_GT(then["systems"][system]["speed"], 20.0) << "in its run-up";
    EXPECT_NEAR(then["systems"][system]["energy"]["potential"].get<double>(),
                run["systems"][system]["energy"]["potential"].get<double>(), 1e-12);
  }
}

TEST(Analyze, PrintsNoNoise) {
  // A circle has no major axis; in a shaft's reduced matrices rounding residues are 0.
  EXPECT_NE(twin({"orbit", kDemo, "--speed", "30"}).out.find("circle"), std::string::npos);
  for (const std::string& line : linesOf(twin({"analyze", "balancing", "--speed", "70"}).out)) {
    if (line.compare(0, 24, "                        ") == 0) {
      EXPECT_EQ(line.find("e-17"), std::string::npos) << line;
      EXPECT_EQ(line.find("e-19"), std::string::npos) << line;
    }
  }
}

TEST(Analyze, StartsWithTheDrive) {
  const Json pendulum = analyzed(
      "{model: spinning_pendulum, drive: shaft, parameters: {mass: 1, length: 1}}",
      "time: 5.0\ndrives: {shaft: {speed: 2.0, profile: [{speed: 9.0, max_acceleration: 1.0}]}}\n");
  EXPECT_EQ(pendulum["speed"], 2.0);
  EXPECT_EQ(pendulum["time"], 5.0);
}

// Each is in range; a rate of one over another, or its square, is not.
TEST(Analyze, NumbersThatOverflowTogetherAreRefused) {
  for (const char* const numbers :
       {"mass: 1e-300, stiffness: 1e300, speed: 0", "mass: 1e-200, stiffness: 1e4, speed: 0",
        "mass: 1, stiffness: 1e308, speed: 0", "mass: 1, stiffness: 1e4, damping: 1e308, speed: 0",
        "mass: 1, stiffness: 1e4, internal_damping: 1e308, speed: 50"}) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write(
        "scene.yaml",
        std::string("{step: 0.001, systems: {it: {model: jeffcott_rotor, parameters: {") + numbers +
            "}}}}");
    const Ending end = twin({"analyze", scene, "--json"});
    EXPECT_EQ(end.status, 2) << numbers;
    EXPECT_EQ(end.out, "");
    EXPECT_NE(end.err.find("systems.it.parameters: together give a fastest rate of"),
              std::string::npos)
        << end.err;
  }
}

TEST(Analyze, ReportForReaders) {
  const Ending end = twin({"analyze", kDemo, "--system", "rotor"});
  EXPECT_EQ(end.status, 0);
  EXPECT_EQ(linesOf(end.out).front(),
            "rotor: jeffcott_rotor, unbalanced disc on a massless flexible shaft");
  for (const char* part : {"stability: asymptotically stable",
                           "log decrement   0.314553\n      valid for any amplitude",
                           "rad/s          Hz   damping ratio", "critical speeds"}) {
    EXPECT_NE(end.out.find(part), std::string::npos) << part << "\n" << end.out;
  }
  EXPECT_EQ(end.out.find("nan"), std::string::npos) << end.out;
}

/// A shaft of 26 elements with all its 108 coordinates; `bearing` and `seal`: coefficients.
std::string longShaft(const std::string& bearing, const std::string& seal) {
  return "{model: flexible_rotor, parameters: {speed: 400, modes: 0, youngs_modulus: 2.11e11, "
         "shear_modulus: 8.12e10, density: 7810, elements: [{count: 26, length: 0.05, "
         "outer_diameter: 0.05}], discs: [{node: 9, mass: 32.0, transverse_inertia: 0.178, "
         "polar_inertia: 0.329}], bearings: [{node: 0, " +
         bearing + "}, {node: 26, " + bearing + "}, {node: 13, " + seal + "}]}}";
}

Json analyzedAll(const std::string& system) {
  const TemporaryDirectory folder;
  const std::string scene =
      folder.write("scene.yaml", "step: 0.001\nsystems:\n  it: " + system + "\n");
  const Ending end = twin({"analyze", scene, "--json", "--modes", "all"});
  EXPECT_EQ(end.status, 0) << end.err;
  return end.json()["systems"]["it"];
}

TEST(Analyze, OfALongShaftTheLowestModesAreThoseOfAll) {
  const std::string shaft = longShaft("kxx: 1e6, kyy: 2e6, cxx: 100, cyy: 100", "kxx: 0");
  const Json lowest = analyzed(shaft);
  const Json all = analyzedAll(shaft);
  EXPECT_EQ(all["omitted"], 0);
  EXPECT_EQ(all["eigenvalues"].size(), 216u);
  EXPECT_EQ(lowest["eigenvalues"].size(), 48u);
  EXPECT_EQ(lowest["omitted"], 216 - 48);
  ASSERT_EQ(lowest["natural_frequencies"].size(), 24u);
  for (std::size_t i = 0; i < 24; ++i) {
    const double frequency = all["natural_frequencies"][i];
    EXPECT_NEAR(lowest["natural_frequencies"][i].get<double>(), frequency, 1.0e-7 * frequency);
  }
  EXPECT_NEAR(lowest["rotor"]["mass"].get<double>(), 32.0 + 7810.0 * 1.3 * 0.0019634954, 1e-6);
  EXPECT_EQ(lowest["rotor"]["static"]["nodes"].size(), 27u);
  EXPECT_EQ(lowest["routh"]["verdict"], "asymptotically_stable");
  EXPECT_EQ(all["routh"]["verdict"], "asymptotically_stable");
  const double highest = lowest["natural_frequencies"].back();
  EXPECT_NEAR(lowest["critical_speeds_searched_to"].get<double>(), highest, 0.1 * highest);
  EXPECT_EQ(lowest["critical_speeds"].size(), all["critical_speeds"].size());
}

// Nothing bounds the energy input of a seal beyond the damping of the bearings: no verdict without
// a proof.
TEST(Analyze, OfALongShaftTheVerdictIsUncertainWhereNothingIsProvedOfTheOmitted) {
  const std::string shaft =
      longShaft("kxx: 1e6, kyy: 1e6, cxx: 5000, cyy: 5000", "kxy: 100.0, kyx: -100.0");
  EXPECT_EQ(analyzed(shaft)["routh"]["verdict"], "uncertain");
  EXPECT_EQ(analyzedAll(shaft)["routh"]["verdict"], "asymptotically_stable");
  const std::string damped = longShaft("kxx: 1e6, kyy: 1e6, cxx: 5000, cyy: 5000",
                                       "kxy: 100.0, kyx: -100.0, cxx: 10.0, cyy: 10.0");
  EXPECT_EQ(analyzed(damped)["routh"]["verdict"], "asymptotically_stable");
}

// Cross-coupling of bearings: where the first forward whirl grows, all commands report it, at the
// same speed.
TEST(Analyze, OfALongShaftThatGrowsTheVerdictIsThatOfAll) {
  const std::string shaft =
      longShaft("kxx: 1e6, kyy: 1e6, cxx: 100, cyy: 100, kxy: 4e4, kyx: -4e4", "kxx: 0");
  EXPECT_EQ(analyzed(shaft)["routh"]["verdict"], "unstable");
  EXPECT_EQ(analyzed(shaft)["routh"]["right"], analyzedAll(shaft)["routh"]["right"]);
}

TEST(Analyze, OfManyCoordinatesTheReportShowsNoMatrices) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write(
      "scene.yaml", "step: 0.001\nsystems:\n  it: " +
                        longShaft("kxx: 1e6, kyy: 1e6, cxx: 9, cyy: 9", "kxx: 0") + "\n");
  const Ending end = twin({"analyze", scene, "--modes", "5"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_LT(linesOf(end.out).size(), 90u) << end.out;
  for (const std::string& line : linesOf(end.out)) {
    EXPECT_LE(line.size(), 120u) << line;
  }
  EXPECT_NE(end.out.find("206 eigenvalues of higher modes are omitted"), std::string::npos)
      << end.out;
  EXPECT_EQ(twin({"analyze", scene, "--modes", "none"}).status, 2);
}

}  // namespace analyze_command_test
}  // namespace whirl_twin
