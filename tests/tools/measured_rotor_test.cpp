// `twin modes` and `twin balance --measured`: results from a log of the running plant, for rotors
// with known modes and unbalances.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "twin_program.h"

namespace whirl_twin {
namespace measured_rotor_test {

constexpr double kRadian = 3.14159265358979323846 / 180.0;
const std::string kScenes = WHIRL_TWIN_SOURCE "/config/scenes/";
const std::string kBalancing = kScenes + "balancing.yaml";

/// A disc with internal damping at 90 rad/s, 1.5 times its critical speed: its forward whirl decays
/// more slowly than the backward one. Unknown random forces excite it; its probes are noisy, its
/// surface has run-out.
std::string shakenRotor(const TemporaryDirectory& folder, double duration) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::string table = "time,x,y\n";
  for (int i = 0; i * 0.004 < duration + 1.0; ++i) {
    table += std::to_string(i * 0.004) + "," + std::to_string(normal(random)) + "," +
             std::to_string(normal(random)) + "\n";
  }
  folder.write("forces.csv", table);
  return folder.write(
      "rotor.yaml",
      "name: shaken\n"
      "step: 0.002\n"
      "drives: {shaft: {speed: 90.0}}\n"
      "systems:\n"
      "  rotor:\n"
      "    model: jeffcott_rotor\n"
      "    drive: shaft\n"
      "    parameters: {mass: 2.0, stiffness: 7200.0, damping: 8.0, internal_damping: 2.0,\n"
      "                 eccentricity: 1.0e-5}\n"
      "    inputs:\n"
      "      force_x: {table: forces.csv, time: time, value: x, hold: true}\n"
      "      force_y: {table: forces.csv, time: time, value: y, hold: true}\n"
      "sensors:\n"
      "  probes:\n"
      "    rate: 500.0\n"
      "    channels:\n"
      "      x: {measures: rotor.x, noise: 3.0e-6, resolution: 1.0e-7, run_out: 8.0e-6}\n"
      "      slant: {measures: rotor, direction: 2.0, noise: 3.0e-6, run_out: 8.0e-6}\n"
      "  tacho: {keyphasor: shaft, jitter: 1.0e-6}\n");
}

/// A log of what its sensors measured; "": of the whirl alone.
std::string logOf(const TemporaryDirectory& folder, const std::string& scene, double duration,
                  bool measured = true) {
  const std::string log = folder.file("run.lcmlog");
  std::vector<std::string> command{"simulate", scene, "--duration", std::to_string(duration),
                                   "--output", log,   "--sample",   "0.002"};
  if (measured) {
    command.insert(command.end(), {"--measure", "sensors"});
  }
  const Ending end = twin(command);
  EXPECT_EQ(end.status, 0) << end.err;
  return log;
}

/// Is the truth within three and a half deviations, and are these of any use?
void expectHolds(const nlohmann::json& estimate, double truth) {
  const double deviation = estimate["standard_deviation"].get<double>();
  EXPECT_NEAR(estimate["value"].get<double>(), truth, 3.5 * deviation);
  EXPECT_LT(deviation, 0.3 * std::fabs(truth));
  EXPECT_NEAR(estimate["interval"][1].get<double>() - estimate["interval"][0].get<double>(),
              4.4 * deviation, 0.5 * deviation);
}

TEST(Modes, OfTheModelAtASpeed) {
  const Ending end = twin({"modes", kDemo, "--speed", "50", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto modes = end.json()["systems"]["rotor"]["modes"];
  ASSERT_EQ(modes.size(), 2u);
  for (const auto& mode : modes) {
    EXPECT_NEAR(mode["frequency"].get<double>(), 60.0 * std::sqrt(1.0 - 0.0025), 1e-9);
    EXPECT_NEAR(mode["decay_rate"].get<double>(), 3.0, 1e-9);
  }
  EXPECT_NE(modes[0]["whirl"], modes[1]["whirl"]);
}

// x and y are at 115 degrees from one another; order removed are an unbalance and a run-out that
// are as large as the vibration.
TEST(Modes, OfAShakenRotorStandBesideTheModels) {
  const TemporaryDirectory folder;
  const std::string scene = shakenRotor(folder, 120.0);
  for (const bool measured : {true, false}) {
    const std::string log = logOf(folder, scene, 120.0, measured);
    const Ending end = twin({"modes", scene, "--measured", log, "--json"});
    ASSERT_EQ(end.status, 0) << end.err;
    const auto rotor = end.json()["systems"]["rotor"];
    EXPECT_NEAR(rotor["speed"].get<double>(), 90.0, 1e-3);
    ASSERT_EQ(rotor["modes"].size(), 2u) << rotor.dump(1);
    EXPECT_EQ(rotor["not_seen"].size(), 0u);
    const auto model =
        twin({"modes", scene, "--speed", "90", "--json"}).json()["systems"]["rotor"]["modes"];
    for (const auto& mode : rotor["modes"]) {
      for (const auto& truth : model) {
        if (truth["whirl"] != mode["whirl"]) {
          continue;
        }
        EXPECT_EQ(mode["model"]["whirl"], truth["whirl"]);
        for (const char* value : {"frequency", "decay_rate", "damping_ratio", "log_decrement"}) {
          expectHolds(mode[value], truth[value].get<double>());
        }
      }
    }
  }
}

TEST(Modes, SayWhatARecordDoesNotTell) {
  const TemporaryDirectory folder;
  const std::string scene = shakenRotor(folder, 6.0);
  const std::string log = logOf(folder, scene, 1.0);
  const Ending end = twin({"modes", scene, "--measured", log});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_NE(end.out.find("too short"), std::string::npos) << end.out;
}

TEST(Modes, RefuseALogOfSomethingElse) {
  const TemporaryDirectory folder;
  const std::string scene = shakenRotor(folder, 2.0);
  const Ending demo = twin({"simulate", kScenes + "pendulum.yaml", "--duration", "1", "--output",
                            folder.file("other.lcmlog")});
  ASSERT_EQ(demo.status, 0) << demo.err;
  const Ending end = twin({"modes", scene, "--measured", folder.file("other.lcmlog")});
  EXPECT_EQ(end.status, 2);
  EXPECT_NE(end.err.find("must have displacement probes at 'rotor'"), std::string::npos) << end.err;
}

TEST(Modes, RefuseAShaftThatTurnsBackwards) {
  const TemporaryDirectory folder;
  std::string text = contentsOf(shakenRotor(folder, 2.0));
  text.replace(text.find("speed: 90.0"), 11, "speed: -90.0");
  const std::string scene = folder.write("backwards.yaml", text);
  const Ending end = twin({"modes", scene, "--measured", logOf(folder, scene, 2.0, false)});
  EXPECT_EQ(end.status, 2) << end.out;
  EXPECT_NE(end.err.find("the shaft must rotate forward"), std::string::npos) << end.err;
}

TEST(Modes, RefuseFrequenciesThatNoRecordTells) {
  const TemporaryDirectory folder;
  const std::string scene = shakenRotor(folder, 2.0);
  const std::string log = logOf(folder, scene, 1.0);
  for (const char* to : {"0", "1e-9", "1e-300", "1e4"}) {
    const Ending end = twin({"modes", scene, "--measured", log, "--to", to});
    EXPECT_EQ(end.status, 2) << to;
    EXPECT_NE(end.err.find("--to: must be a frequency from 0.05 to 1257 rad/s"), std::string::npos)
        << end.err;
  }
}

/// 6.0e-4 kg m at 0.9 rad and 9.0e-4 kg m at 3.6 rad, as the shipped scene hides them.
void expectHiddenUnbalances(const nlohmann::json& report) {
  const double size[] = {6.0e-4, 9.0e-4};
  const double angle[] = {0.9 / kRadian, 3.6 / kRadian - 360.0};
  const char* plane[] = {"node_2", "node_4"};
  for (int i = 0; i < 2; ++i) {
    const auto found = report["unbalance"][plane[i]];
    EXPECT_NEAR(found["mass_radius"].get<double>(), size[i], 0.02 * size[i]);
    EXPECT_NEAR(found["angle"].get<double>(), angle[i], 2.0);
    const auto add = report["correction"][plane[i]];
    EXPECT_NEAR(std::remainder(add["angle"].get<double>() - angle[i] - 180.0, 360.0), 0.0, 2.0);
    EXPECT_LT(found["mass_radius_deviation"].get<double>(), 0.02 * size[i]);
    EXPECT_LT(std::fabs(found["mass_radius"].get<double>() - size[i]),
              5.0 * found["mass_radius_deviation"].get<double>());
  }
}

TEST(BalanceMeasured, FindsWhatTheShippedSceneHidesFromItsRunUp) {
  const TemporaryDirectory folder;
  const std::string log = logOf(folder, kBalancing, 14.0);
  const Ending end = twin({"balance", kBalancing, "--measured", log, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto report = end.json();
  EXPECT_EQ(report["rank_deficiency"], 0);
  EXPECT_LT(report["residual_beyond_noise"].get<double>(), 1.2);
  expectHiddenUnbalances(report);

  // At one speed run-out and unbalance are indistinguishable; only the free decay at the end of the
  // run-up gives a little information.
  const Ending one =
      twin({"balance", kBalancing, "--measured", log, "--json", "--from", "69.99999"});
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_GE(one.json()["rank_deficiency"].get<int>(), 2);
  EXPECT_TRUE(one.json()["unbalance"]["node_2"]["mass_radius"].is_null());
  EXPECT_TRUE(one.json()["unbalance"]["node_4"]["mass_radius"].is_null());
  EXPECT_NE(
      one.json()["notes"].dump().find("at one speed run-out and unbalance have the same effect"),
      std::string::npos);

  const Ending known = twin({"balance", kBalancing, "--measured", log, "--json", "--from",
                             "69.99999", "--known-run-out"});
  ASSERT_EQ(known.status, 0) << known.err;
  expectHiddenUnbalances(known.json());
}

/// The probes of the shipped scene on two acquisition units.
std::string onTwoUnits(const TemporaryDirectory& folder, const std::string& rate) {
  std::string text = contentsOf(kBalancing);
  const std::size_t second = text.find("      x_5: {");
  text.insert(second, "  drive_end:\n    rate: " + rate + "\n    channels:\n");
  return folder.write("two_units.yaml", text);
}

// The reference are the four probes on one unit: the same unknowns from as many samples.
TEST(BalanceMeasured, UsesTheProbesOfAllSources) {
  const TemporaryDirectory folder;
  const auto report = [](const std::string& scene, const std::string& log) {
    const Ending end = twin({"balance", scene, "--measured", log, "--json"});
    EXPECT_EQ(end.status, 0) << end.err;
    return end.json();
  };
  const auto one = report(kBalancing, logOf(folder, kBalancing, 14.0));
  for (const char* rate : {"2000.0", "1250.0"}) {
    const std::string scene = onTwoUnits(folder, rate);
    const auto two = report(scene, logOf(folder, scene, 14.0));
    expectHiddenUnbalances(two);
    ASSERT_EQ(two["run_out"].size(), 4u) << two.dump(1);
    EXPECT_TRUE(two["run_out"].contains("probes/x_1")) << two.dump(1);
    EXPECT_TRUE(two["run_out"].contains("drive_end/x_5")) << two.dump(1);
    for (const char* plane : {"node_2", "node_4"}) {
      EXPECT_NEAR(two["unbalance"][plane]["mass_radius_deviation"].get<double>(),
                  one["unbalance"][plane]["mass_radius_deviation"].get<double>(),
                  0.4 * one["unbalance"][plane]["mass_radius_deviation"].get<double>());
    }
  }
  // A probe that the log lacks is reported.
  std::string text = contentsOf(onTwoUnits(folder, "2000.0"));
  text.replace(text.find("drive_end:"), 10, "other_end:");
  const auto half = report(folder.write("other.yaml", text), folder.file("run.lcmlog"));
  EXPECT_EQ(half["run_out"].size(), 2u);
  EXPECT_NE(half["notes"].dump().find("the log has no samples of other_end"), std::string::npos);
}

// x and y of a station on two units are one whirl where they are sampled together.
TEST(Modes, OfProbesOnTwoUnits) {
  const TemporaryDirectory folder;
  std::string text = contentsOf(shakenRotor(folder, 60.0));
  const std::string second = "  unit:\n    rate: 500.0\n    channels:\n";
  text.insert(text.find("      slant:"), second);
  const std::string scene = folder.write("units.yaml", text);
  const Ending end = twin({"modes", scene, "--measured", logOf(folder, scene, 60.0), "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.json()["systems"]["rotor"]["modes"].size(), 2u) << end.out;
  text.replace(text.find(second), second.size(), "  unit:\n    rate: 250.0\n    channels:\n");
  const std::string slower = folder.write("slower.yaml", text);
  const Ending left = twin({"modes", slower, "--measured", logOf(folder, slower, 60.0), "--json"});
  ASSERT_EQ(left.status, 0) << left.err;
  EXPECT_NE(left.out.find("is not used: its samples are not simultaneous with those of"),
            std::string::npos)
      << left.out;
}

TEST(BalanceMeasured, RefusesPlanesThatAreNotThereAndOptionsWithoutALog) {
  const TemporaryDirectory folder;
  const std::string log = logOf(folder, kBalancing, 2.0);
  const Ending plane = twin({"balance", kBalancing, "--measured", log, "--planes", "node_22"});
  EXPECT_EQ(plane.status, 2);
  EXPECT_NE(
      plane.err.find("no station 'node_22' on rotor (flexible_rotor); did you mean 'node_2'?"),
      std::string::npos)
      << plane.err;
  EXPECT_EQ(twin({"balance", "runs.yaml", "--planes", "node_2"}).status, 2);
  const Ending none = twin({"balance", kBalancing, "--measured", log, "--from", "500"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("from 500 to 1e+06 rad/s, found none"), std::string::npos) << none.err;
}

}  // namespace measured_rotor_test
}  // namespace whirl_twin
