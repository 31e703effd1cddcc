// `twin loop`: the loops that controllers close, as they are sampled.
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

// A magnet whose law takes its negative stiffness away and no more stands nowhere.
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

/// [A], at the shaft's speed: the forward part of the current of the first magnet of the shipped
/// scene at a constant speed [rad/s], its sensors without noise, from `from` to `to` [s].
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

TEST(Loop, IsDrawn) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", levitation(2.0, 1.4, 0.1, 0.03));
  const std::string picture = folder.file("loop.svg");
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
  EXPECT_NE(end.err.find("demo: controllers: expected at least one, found none"), std::string::npos)
      << end.err;
}

}  // namespace loop_command_test
}  // namespace whirl_twin
