// The table and the JSON of `twin simulate`: their columns, and that the numbers are exact.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "twin_program.h"

namespace whirl_twin {
namespace simulate_table_test {

using Json = nlohmann::json;

/// The fields of a row.
std::vector<std::string> fields(const std::string& row) {
  std::vector<std::string> all;
  std::istringstream stream(row);
  for (std::string field; std::getline(stream, field, ',');) {
    all.push_back(field);
  }
  return all;
}

Lines table(const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"simulate"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Ending end = twin(arguments);
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.err, "");
  return linesOf(end.out);
}

TEST(Table, HeaderAndRows) {
  const Lines rows = table({kDemo, "--duration", "0.5", "--sample", "0.01"});
  ASSERT_EQ(rows.size(), 1u + 51u);
  EXPECT_EQ(rows[0],
            "time,rotor.x,rotor.y,rotor.x_rate,rotor.y_rate,rotor.whirl_radius,rotor.whirl_phase,"
            "rotor.disc.x,rotor.disc.y,rotor.shaft_speed,rotor.shaft_angle,"
            "pendulum.theta,pendulum.theta_rate,pendulum.shaft_speed,pendulum.shaft_angle");
  EXPECT_EQ(rows[1], "0,0,0,0,0,0,nan,0,0,0,0,0.050000000000000003,0,0,0");
  EXPECT_EQ(fields(rows[2])[0], "0.01");
  EXPECT_EQ(fields(rows.back())[0], "0.5");
}

TEST(Table, EveryStepByDefault) {
  EXPECT_EQ(table({kDemo, "--duration", "0.05"}).size(), 1u + 51u);
  EXPECT_EQ(table({kDemo, "--duration", "0"}).size(), 1u + 1u);
}

TEST(Table, OneSystemOnly) {
  const Lines all = table({kDemo, "--duration", "0.2"});
  const Lines one = table({kDemo, "--duration", "0.2", "--system", "pendulum"});
  ASSERT_EQ(one.size(), all.size());
  EXPECT_EQ(one[0],
            "time,pendulum.theta,pendulum.theta_rate,pendulum.shaft_speed,pendulum.shaft_angle");
  const auto whole = fields(all.back());
  EXPECT_EQ(fields(one.back()),
            (std::vector<std::string>{whole[0], whole[11], whole[12], whole[13], whole[14]}));
}

// The demo's profile: 1.2 s + 3 s, then two longer moves; its sum is in `twin check`.
TEST(Table, LastsAsLongAsTheLongestProfile) {
  const double profile =
      twin({"check", kDemo, "--json"}).json()["drives"]["shaft"]["duration"].get<double>();
  const Json end = twin({"simulate", kDemo, "--json"}).json();
  EXPECT_GE(end["duration"].get<double>(), profile - 1e-9);
  EXPECT_LT(end["duration"].get<double>(), profile + 0.001);
}

TEST(Table, LastsTenSecondsWithoutAProfile) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write(
      "scene.yaml",
      "step: 0.003\nsystems: {p: {model: spinning_pendulum, parameters: {mass: 1, length: 1, "
      "speed: 1}}}");
  // Ten seconds are not whole steps of 3 ms: the next one that is.
  EXPECT_EQ(twin({"simulate", scene, "--json"}).json()["steps"], 3334);
}

TEST(Table, SameInputSameBytes) {
  for (const char* format : {"--json", "--sample=0.01"}) {
    const Ending first = twin({"simulate", kDemo, format});
    const Ending second = twin({"simulate", kDemo, format});
    EXPECT_EQ(first.status, 0);
    EXPECT_EQ(first.out, second.out);
  }
}

// Through the critical speed the phase passes many turns; sampled every 0.1 s or every step, it is
// the same, because it is unwrapped from step to step.
TEST(Table, SamplingChangesNoValue) {
  const Lines coarse = table({kDemo, "--duration", "20", "--sample", "0.1"});
  const Lines fine = table({kDemo, "--duration", "20"});
  ASSERT_EQ(fine.size(), 1u + 20001u);
  ASSERT_EQ(coarse.size(), 1u + 201u);
  for (std::size_t i = 1; i < coarse.size(); ++i) {
    EXPECT_EQ(coarse[i], fine[1 + 100 * (i - 1)]);
  }
}

// Free vibration of an undamped rotor by the exponential method: x = x0 cos p t, whatever the step.
// One rounding a step: sqrt(1000) ulp and a margin of ten.
TEST(Table, FreeVibrationIsExact) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.yaml", R"(
step: 0.01
systems:
  r: {model: jeffcott_rotor, parameters: {mass: 1, stiffness: 100, speed: 0}, initial: {x: 0.001}}
)");
  const auto last = fields(table({scene, "--duration", "10"}).back());
  EXPECT_NEAR(std::stod(last[1]), 0.001 * std::cos(100.0), 1e-16);
  EXPECT_NEAR(std::stod(last[3]), -0.01 * std::sin(100.0), 1e-15);
  EXPECT_EQ(std::stod(last[5]), std::fabs(std::stod(last[1]))) << "whirl radius";
}

// 17 significant digits are enough to give every double back.
TEST(Table, DigitsAndJsonAreTheSameNumbers) {
  const auto last = fields(table({kDemo, "--duration", "3"}).back());
  const Json end = twin({"simulate", kDemo, "--duration", "3", "--json"}).json();
  const Json& rotor = end["systems"]["rotor"];
  EXPECT_EQ(rotor["state"]["x"], std::stod(last[1]));
  EXPECT_EQ(rotor["state"]["y_rate"], std::stod(last[4]));
  EXPECT_EQ(rotor["whirl_radius"], std::stod(last[5]));
  EXPECT_EQ(rotor["whirl_phase"], std::stod(last[6]));
  EXPECT_EQ(end["systems"]["pendulum"]["state"]["theta_rate"], std::stod(last[12]));
}

TEST(Table, JsonHasTheFinalState) {
  const Json end = twin({"simulate", kDemo, "--duration", "2", "--json"}).json();
  EXPECT_EQ(end["scene"], "demo");
  EXPECT_EQ(end["step"], 0.001);
  EXPECT_EQ(end["duration"], 2.0);
  EXPECT_EQ(end["steps"], 2000);
  EXPECT_EQ(end["time"], 2.0);
  const Json& rotor = end["systems"]["rotor"];
  EXPECT_EQ(rotor["integrator"], "exponential");
  EXPECT_EQ(rotor["status"], "ok");
  EXPECT_EQ(rotor["steps"], 2000);
  EXPECT_EQ(rotor["state"].size(), 4u);
  for (const char* key : {"kinetic", "potential", "jacobi"}) {
    EXPECT_TRUE(rotor["energy"][key].is_number()) << key;
  }
  EXPECT_LT(std::fabs(rotor["energy_residual"].get<double>()), 1e-6);
  EXPECT_FALSE(end["systems"]["pendulum"].contains("whirl_radius"));
  // At rest the phase is undefined: NaN, which JSON cannot represent.
  const Json start = twin({"simulate", kDemo, "--duration", "0", "--json"}).json();
  EXPECT_TRUE(start["systems"]["rotor"]["whirl_phase"].is_null());
}

TEST(Table, StepAndIntegratorCanBeChosen) {
  const Json chosen = twin({"simulate", kDemo, "--duration", "1", "--step", "0.0005",
                            "--integrator", "runge_kutta_4", "--json"})
                          .json();
  EXPECT_EQ(chosen["step"], 0.0005);
  EXPECT_EQ(chosen["steps"], 2000);
  EXPECT_EQ(chosen["systems"]["rotor"]["integrator"], "runge_kutta_4");
  EXPECT_EQ(chosen["systems"]["pendulum"]["integrator"], "runge_kutta_4");
  // Two methods of order 4 and 6 agree on a slow pendulum far better than on nothing.
  const Json own = twin({"simulate", kDemo, "--duration", "1", "--json"}).json();
  EXPECT_NEAR(chosen["systems"]["pendulum"]["state"]["theta"],
              own["systems"]["pendulum"]["state"]["theta"].get<double>(), 1e-9);
}

TEST(Table, OfOneSystemTheIntegratorOnlyThere) {
  const Ending end = twin({"simulate", kDemo, "--duration", "0.1", "--system", "rotor",
                           "--integrator", "exponential", "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.json()["systems"].size(), 1u);
}

}  // namespace simulate_table_test
}  // namespace whirl_twin
