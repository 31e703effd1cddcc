// `twin loop`: the sampled loops that controllers close.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "twin_program.h"

namespace whirl_twin {
namespace loop_command_test {

using Json = nlohmann::json;

/// x'' = x + u under a PD law, the derivative a backward difference.
std::string levitation(double kp, double kd, double period, double delay) {
  return fmt::format(
      "{{step: 0.001, systems: {{s: {{model: linear_system, parameters: {{names: [x], mass: "
      "[[1.0]], stiffness: [[-1.0]]}}}}}}, controllers: {{pd: {{type: pid, rate: {:.17g}, "
      "measures: "
      "[s.x], acts_on: [s.force_x], delay: {:.17g}, parameters: {{kp: {:.17g}, ki: 0.0, kd: "
      "{:.17g}}}}}}}}}",
      1.0 / period, delay, kp, kd);
}

Json controllerOf(const std::string& scene) {
  const TemporaryDirectory folder;
  const Ending end = twin({"loop", folder.write("scene.yaml", scene), "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  return end.json()["controllers"]["pd"];
}

// T = 0.1 s, none, one and two samples of delay: spectral radii by powers of the transition matrix
// in higher precision.
TEST(Loop, SpectralRadiiOfALevitatedMass) {
  const double kd = std::sqrt(2.0);
  EXPECT_NEAR(controllerOf(levitation(2.0, kd, 0.1, 0.0))["spectral_radius"], 0.926077894, 1e-9);
  EXPECT_NEAR(controllerOf(levitation(2.0, kd, 0.1, 0.1))["spectral_radius"], 0.926013966, 1e-9);
  EXPECT_NEAR(controllerOf(levitation(2.0, kd, 0.1, 0.2))["spectral_radius"], 0.931151178, 1e-9);
  EXPECT_NEAR(controllerOf(levitation(1.5, 1.0, 0.1, 0.0))["spectral_radius"], 0.949893757, 1e-9);
  EXPECT_NEAR(controllerOf(levitation(1.5, 1.0, 0.1, 0.1))["spectral_radius"], 0.953405746, 1e-9);
  EXPECT_NEAR(controllerOf(levitation(1.5, 1.0, 0.1, 0.2))["spectral_radius"], 0.959262159, 1e-9);
}

// Nothing depends on the angle of an engine's shaft: it drifts, and is no part of the loop.
TEST(Loop, OfAShaftAtSpeedIsStableWhateverItsAngle) {
  const Ending end = twin({"loop", WHIRL_TWIN_SOURCE "/config/scenes/throttle.yaml", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json throttle = end.json()["controllers"]["throttle"];
  EXPECT_EQ(throttle["verdict"], "asymptotically_stable");
  EXPECT_LT(throttle["spectral_radius"], 0.999);
  EXPECT_EQ(throttle["zone"], "A");
}

TEST(Loop, IsStableUpToALongestPeriod) {
  const double kd = std::sqrt(2.0);
  EXPECT_EQ(controllerOf(levitation(2.0, kd, 0.69, 0.0))["verdict"], "asymptotically_stable");
  EXPECT_EQ(controllerOf(levitation(2.0, kd, 0.70, 0.0))["verdict"], "unstable");
  const Json unstable = controllerOf(levitation(2.0, kd, 0.32, 0.32));
  EXPECT_EQ(unstable["verdict"], "unstable");
  EXPECT_EQ(unstable["zone"], "unbounded");
  EXPECT_GT(unstable["spectral_radius"], 1.0);
}

// Fast sampling: the margins of the continuous loop. Peak sqrt(2) at 1 rad/s, 42.94 degrees.
TEST(Loop, MarginsOfALevitatedMass) {
  const Json fast = controllerOf(levitation(2.0, std::sqrt(2.0), 1.0e-4, 0.0));
  EXPECT_NEAR(fast["sensitivity_peak"], std::sqrt(2.0), 1e-3);
  EXPECT_EQ(fast["zone"], "A");
  EXPECT_NEAR(fast["phase_margin"].get<double>() * 180.0 / M_PI, 42.9414, 0.01);
  EXPECT_NEAR(fast["delay_margin"], 0.5694731892, 2e-4);
  EXPECT_NEAR(fast["gain_reduction"], 0.5, 1e-6) << "the net stiffness is gone";
  EXPECT_EQ(fast["axes"][0]["signal"], "s.x");
}

// A controlled magnet whose controller cancels exactly its negative stiffness has no restoring
// force.
TEST(Loop, WithoutNetStiffnessItIsMarginal) {
  EXPECT_EQ(controllerOf(levitation(1.0, 0.5, 0.125, 0.0))["verdict"], "marginal");
}

TEST(Loop, IsPartOfAnalyze) {
  const std::string scene = levitation(2.0, std::sqrt(2.0), 0.1, 0.03);
  const TemporaryDirectory folder;
  const Ending end = twin({"analyze", folder.write("scene.yaml", scene), "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.json()["controllers"]["pd"], controllerOf(scene));
}

/// [A], at the shaft's speed: the forward component of the current of the first magnet of the
/// shipped scene at a constant speed [rad/s], its sensors without noise, from `from` to `to` [s].
double currentAtSpeed(double speed, bool notch, double from, double to) {
  std::string scene = contentsOf(WHIRL_TWIN_SOURCE "/config/scenes/levitation.yaml");
  scene = std::regex_replace(scene, std::regex("shaft: \\{.*"),
                             fmt::format("shaft: {{speed: {}}}", speed));
  scene = std::regex_replace(scene, std::regex("sensor: .*"), "");
  if (!notch) {
    scene = scene.substr(0, scene.find("      notch_rate"));
  }
  const TemporaryDirectory folder;
  const std::string table = folder.file("run.csv");
  const Ending end = twin({"simulate", folder.write("scene.yaml", scene), "--duration",
                           fmt::format("{}", to), "--output", table});
  EXPECT_EQ(end.status, 0) << end.err;
  std::istringstream rows(contentsOf(table));
  std::string row;
  std::getline(rows, row);
  std::vector<std::string> names;
  std::istringstream header(row);
  for (std::string name; std::getline(header, name, ',');) {
    names.push_back(name);
  }
  const double whole = std::floor((to - from) * speed / (2.0 * M_PI)) * 2.0 * M_PI / speed;
  std::vector<double> times;
  std::vector<std::complex<double>> currents;
  std::complex<double> carrying = 0.0;  // the weight
  while (std::getline(rows, row)) {
    std::map<std::string, double> value;
    std::istringstream cells(row);
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ',');) {
      value[names.at(column++)] = std::stod(cell);
    }
    const double time = value["time"];
    if (time >= from && time < from + whole) {
      times.push_back(time);
      currents.emplace_back(value["magnets.rotor.current_x_1"], value["magnets.rotor.current_y_1"]);
      carrying += currents.back();
    }
  }
  const auto count = static_cast<double>(times.size());
  carrying /= count;
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    sum += std::polar(1.0, -speed * times[i]) * (currents[i] - carrying);
  }
  return std::abs(sum) / count;
}

// Below the rotor's critical speeds, where a plain notch is unstable, between them and above.
TEST(Loop, TheNotchOfLevitationTakesTheCurrentAtTheShaftsSpeedAway) {
  for (const double speed : {200.0, 450.0, 1500.0}) {
    const double before = currentAtSpeed(speed, false, 3.0, 4.0);
    EXPECT_GT(before, 5e-3) << speed;
    EXPECT_LT(currentAtSpeed(speed, true, 8.0, 9.0), 1e-3 * before) << speed;
  }
}

// 2 / (5 s + 1) with a dead time of 1 s: numbers of the loop sampled at each rate, from
// L = 2 (1 - a) z^-n / (z - a), a = exp(-0.2 T), n T = 1 s, solved for |L| = 1 and arg L = -180
// degrees; without sampling 4.25121, 100.1522 degrees and 5.0460 s.
TEST(Loop, ADeadTimeOfManySamplesHasTheMarginsOfItsClosedForm) {
  struct Right {
    double rate, gain, phase, delay;  // Hz, -, degrees, s
  };
  for (const Right& right :
       {Right{20.0, 4.154243, 99.654384, 5.020835}, Right{200.0, 4.24142, 100.10252, 5.043496},
        Right{500.0, 4.247293, 100.13231, 5.044998}}) {
    const Json found = controllerOf(fmt::format(
        "{{step: 0.001, systems: {{p: {{model: mass_spring_damper, parameters: {{mass: 5.0, "
        "stiffness: 0.0, damping: 1.0}}}}}}, controllers: {{pd: {{type: pid, rate: {}, measures: "
        "[p.x_rate], acts_on: [p.force], delay: 1.0, parameters: {{kp: 2.0, ki: 0.0, kd: "
        "0.0}}}}}}}}",
        right.rate));
    EXPECT_NEAR(found["gain_margin"], right.gain, 1e-5) << right.rate;
    EXPECT_NEAR(found["phase_margin"].get<double>() * 180.0 / M_PI, right.phase, 1e-4)
        << right.rate;
    EXPECT_NEAR(found["delay_margin"], right.delay, 1e-5) << right.rate;
  }
}

// A rotor of 19.68 kg held 0.15 mm off the centre of its magnetic bearings, along y, where it has
// its weight, and along x.
TEST(Loop, HoldsARotorWithTheCurrentsThatBalanceIt) {
  const TemporaryDirectory folder;
  const Ending end = twin({"loop", folder.write("scene.yaml", R"(step: 0.001
gravity: 9.81
systems:
  rotor:
    model: flexible_rotor
    parameters:
      speed: 0.0
      youngs_modulus: 2.1e11
      density: 7800.0
      modes: 0
      internal_damping: 1.0e-5
      gravity_on_shaft: true
      elements: [{length: 0.1, outer_diameter: 0.08, count: 4}]
      discs: [{node: 2, mass: 4.0, polar_inertia: 0.02, transverse_inertia: 0.011}]
      magnets:
        - {node: 0, ki: 100.0, bias: 1.0, gap: 5.0e-4}
        - {node: 4, ki: 100.0, bias: 1.0, gap: 5.0e-4}
      stations: [{node: 0}, {node: 4}]
controllers:
  pd:
    type: pid
    rate: 20000.0
    measures: [rotor.node_0.x, rotor.node_0.y, rotor.node_4.x, rotor.node_4.y]
    acts_on: [rotor.current_x_0, rotor.current_y_0, rotor.current_x_4, rotor.current_y_4]
    parameters: {kp: 5.0e3, ki: 5.0e4, kd: 20.785, derivative_time: 5.0e-5, setpoint: 1.5e-4}
)"),
                           "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json found = end.json()["controllers"]["pd"];
  const Json& currents = found["held"]["outputs"];
  // Of two poles with k = ki gap^2 / (4 bias); two magnets carry the weight.
  const auto force = [](double i) {
    const double k = 100.0 * 5.0e-4 * 5.0e-4 / 4.0;
    return k * (std::pow((1.0 + i) / 3.5e-4, 2) - std::pow((1.0 - i) / 6.5e-4, 2));
  };
  const double mass = 4.0 + 7800.0 * 0.4 * M_PI * 0.04 * 0.04;
  EXPECT_NEAR(force(currents["rotor.current_x_0"]), 0.0, 1e-6);
  EXPECT_NEAR(force(currents["rotor.current_y_0"]), 0.5 * mass * 9.81, 1e-6);
  EXPECT_NEAR(currents["rotor.current_y_0"], 0.4116, 1e-4);
  EXPECT_NEAR(found["axes"][1]["sensitivity_peak"], 3.165, 1e-3);
}

// The delay margin of four axes at once is below that of each alone (0.71 ms).
TEST(Loop, OfLevitationBearsLessDelayAtOnceThanAtEachSensor) {
  const Ending end = twin({"loop", "levitation", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json magnets = end.json()["controllers"]["magnets"];
  const double at_once = magnets["all_at_once"]["delay_margin"];
  EXPECT_EQ(magnets["delay_margin"], at_once);
  for (const char* places : {"axes", "plant_inputs"}) {
    ASSERT_EQ(magnets[places].size(), 4U);
    for (const Json& place : magnets[places]) {
      EXPECT_GT(place["delay_margin"], 1.4 * at_once);
    }
  }
  // The loop itself, later by a little less and a little more.
  const std::string scene = contentsOf(WHIRL_TWIN_SOURCE "/config/scenes/levitation.yaml");
  const TemporaryDirectory folder;
  for (const double part : {0.97, 1.03}) {
    const std::string late =
        std::regex_replace(scene, std::regex("delay: [0-9.e-]+"),
                           fmt::format("delay: {:.9f}", 5.0e-5 + part * at_once),
                           std::regex_constants::format_first_only);
    const Ending judged = twin({"loop", folder.write("late.yaml", late), "--json"});
    ASSERT_EQ(judged.status, 0) << judged.err;
    EXPECT_EQ(judged.json()["controllers"]["magnets"]["verdict"],
              part < 1.0 ? "asymptotically_stable" : "unstable");
  }
}

// The inverted pendulum of the Control Tutorials for MATLAB, M 0.5, m 0.2, b 0.1, l 0.3, I 0.006, Q
// = diag(1, 1, 0, 0), R = 1: K computed by an independent Riccati equation.
TEST(Loop, ShowsTheGainThatADesignHasComputed) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write(
      "scene.yaml",
      "step: 0.001\ngravity: 9.8\nsystems:\n  c: {model: cart_pendulum, parameters: {cart_mass: "
      "0.5, "
      "rod_mass: 0.2, rod_length: 0.6, stiffness: 0.0, damping: 0.1}, initial: {theta: "
      "3.141592653589793, x: 0.1}}\ncontrollers:\n  k: {type: lqr, rate: 1000.0, measures: [c.x, "
      "c.theta, c.x_rate, c.theta_rate], acts_on: [c.force], parameters: {q: [1.0, 1.0, 0.0, 0.0], "
      "r: [1.0], cost: continuous, setpoint: [0.0, 3.141592653589793, 0.0, 0.0]}}\n");
  const Ending end = twin({"loop", scene, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json feedback = end.json()["controllers"]["k"]["gains"]["feedback"];
  const std::vector<double> expected{-1.0, 18.6854, -1.65671, 3.45944};
  ASSERT_EQ(feedback.size(), 1U);
  ASSERT_EQ(feedback[0].size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(feedback[0][i].get<double>(), expected[i], 1e-4 * std::fabs(expected[i]));
  }
  EXPECT_NE(twin({"loop", scene}).out.find("K of u = -K (y - setpoint)"), std::string::npos);
}

// A first sample y moves the estimate by M y and the output by -K M y: the law has that as D.
TEST(Loop, ShowsFeedbackAndEstimatorOfAnLqg) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write(
      "scene.yaml",
      "step: 0.001\nsystems: {m: {model: mass_spring_damper, parameters: {mass: 2.0, stiffness: "
      "50.0, damping: 0.1}}}\ncontrollers: {k: {type: lqg, rate: 100.0, measures: [m.x], acts_on: "
      "[m.force], parameters: {q: [1.0, 1.0], r: [1.0], process_noise: [0.1, 0.1], sensor_noise: "
      "[0.01]}}}\n");
  const Ending end = twin({"loop", scene, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json k = end.json()["controllers"]["k"];
  EXPECT_EQ(k["gains"]["feedback"].size(), 1U);
  EXPECT_EQ(k["gains"]["feedback"][0].size(), 2U);
  EXPECT_EQ(k["gains"]["estimator"].size(), 2U);
  EXPECT_EQ(k["law"]["a"].size(), 2U);
  double direct = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    direct -=
        k["gains"]["feedback"][0][i].get<double>() * k["gains"]["estimator"][i][0].get<double>();
  }
  EXPECT_NEAR(k["law"]["d"][0][0].get<double>(), direct, 1e-9 * std::fabs(direct));
}

TEST(Loop, IsDrawn) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", levitation(2.0, 1.4, 0.1, 0.03));
  const std::string picture = folder.file("loop.json");
  const Ending end = twin({"loop", scene, "--plot", picture});
  ASSERT_EQ(end.status, 0) << end.err;
  const std::string svg = contentsOf(picture);
  for (const char* words : {"sensitivity, zones of ISO 14839-3", "Nyquist", "phase of L"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(twin({"loop", scene, "--plot", "loop.txt"}).status, 2);
}

TEST(Loop, NeedsAController) {
  const Ending end = twin({"loop", "demo"});
  EXPECT_EQ(end.status, 2);
  EXPECT_NE(end.err.find("demo.yaml: controllers: expected at least one, found none"),
            std::string::npos)
      << end.err;
}

}  // namespace loop_command_test
}  // namespace whirl_twin
