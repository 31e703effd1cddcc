// `twin check`: a valid scene is summarized, an invalid one is rejected with all its errors.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace check_command_test {

using Json = nlohmann::json;

TEST(Check, TellsWhatTheDemoModels) {
  const Ending end = twin({"check", kDemo, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.err, "");
  const Json check = end.json();
  EXPECT_EQ(check["scene"], "demo");
  EXPECT_EQ(check["file"], kDemo);
  EXPECT_EQ(check["step"], 0.001);
  EXPECT_EQ(check["time"], 0.0);

  const Json& rotor = check["systems"]["rotor"];
  EXPECT_EQ(rotor["model"], "jeffcott_rotor");
  EXPECT_EQ(rotor["coordinates"], Json({"x", "y"}));
  EXPECT_EQ(rotor["states"], 4);
  EXPECT_EQ(rotor["drive"], "shaft");
  EXPECT_TRUE(rotor["speed"].is_null());
  EXPECT_EQ(rotor["integrator"], "exponential");
  EXPECT_NE(rotor["reason"], "");
  EXPECT_EQ(rotor["substeps"], 1);
  EXPECT_EQ(rotor["topics"][0],
            Json({{"topic", "/twin/rotor/whirl"}, {"type", "whirl_twin/WhirlState"}}));
  EXPECT_EQ(rotor["topics"][1],
            Json({{"topic", "/twin/rotor/joint_states"}, {"type", "sensor_msgs/JointState"}}));
  EXPECT_EQ(rotor["topics"][3],
            Json({{"topic", "/twin/rotor/orders"}, {"type", "whirl_twin/OrderState"}}));
  EXPECT_EQ(rotor["topics"][4],
            Json({{"topic", "/twin/rotor/parameters"}, {"type", "whirl_twin/ParameterChange"}}));
  EXPECT_EQ(rotor["channels"], Json({"TWIN_ROTOR_WHIRL", "TWIN_ROTOR_STABILITY",
                                     "TWIN_ROTOR_ORDERS", "TWIN_ROTOR_PARAMETER"}));
  EXPECT_GT(rotor["ns_per_step"], 0.0);

  const Json& pendulum = check["systems"]["pendulum"];
  EXPECT_EQ(pendulum["topics"][0],
            Json({{"topic", "/twin/pendulum/pendulum"}, {"type", "whirl_twin/PendulumState"}}));
  EXPECT_EQ(pendulum["channels"],
            Json({"TWIN_PENDULUM_PENDULUM", "TWIN_PENDULUM_STABILITY", "TWIN_PENDULUM_PARAMETER"}));

  const Json& shaft = check["drives"]["shaft"];
  EXPECT_EQ(shaft["topics"][0],
            Json({{"topic", "/twin/drives/shaft"}, {"type", "whirl_twin/DriveState"}}));
  EXPECT_EQ(shaft["channels"], Json({"TWIN_SHAFT_DRIVE"}));
  EXPECT_EQ(shaft["profile"].size(), 3u);
  EXPECT_GT(check["ns_per_step"], 0.0);
  EXPECT_GT(check["real_time_factor"], 1.0);
  EXPECT_GT(check["record_bytes"], 0);
}

// A jerk-limited move of dv with the acceleration limit A reached lasts dv/A + A/J; without a jerk
// limit dv/A.
TEST(Check, TellsWhatIsPromisedOfEachSystem) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("three.yaml", R"(
name: three
step: 0.01
systems:
  exact: {model: jeffcott_rotor, tolerance: 1.0e-9, horizon: 2.0,
    parameters: {mass: 1, stiffness: 100, speed: 5, eccentricity: 0.001}}
  rough: {model: double_pendulum, integrator: velocity_verlet, horizon: 2.0,
    parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}, initial: {theta1: 1}}
  tumbling: {model: double_pendulum, tolerance: 1.0e-9, horizon: 100.0,
    parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}, initial: {theta1: 3, theta2: 3}}
)");
  const Ending end = twin({"check", scene, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;  // without a valid error bound it can still run
  const Json exact = end.json()["systems"]["exact"]["accuracy"];
  EXPECT_EQ(exact["tolerance"], 1.0e-9);
  EXPECT_EQ(exact["horizon"], 2.0);
  EXPECT_EQ(exact["kept"], true);
  EXPECT_EQ(exact["kept_until"], 2.0);
  EXPECT_EQ(exact["known_until"], 2.0);
  EXPECT_LT(exact["error"].get<double>(), 1.0e-12);
  const Json rough = end.json()["systems"]["rough"]["accuracy"];
  EXPECT_EQ(rough["kept"], false);
  EXPECT_EQ(rough["known_until"], 2.0);
  EXPECT_GT(rough["error"].get<double>(), 1.0e-5);
  EXPECT_GT(rough["rate_error"].get<double>(), 1.0e-5);
  EXPECT_LT(rough["reference_error"].get<double>(), 1.0e-7);
  const Json tumbling = end.json()["systems"]["tumbling"]["accuracy"];
  EXPECT_EQ(tumbling["kept"], false);
  EXPECT_LT(tumbling["known_until"].get<double>(), 20.0);
  EXPECT_GT(tumbling["kept_until"].get<double>(), 1.0);
}

TEST(Check, TimesTheMovesOfADrive) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.yaml", R"(
step: 0.01
drives:
  a:
    profile:
      - {speed: 10.0, max_acceleration: 2.0, max_jerk: 4.0, dwell: 1.5}
      - {speed: -10.0, max_acceleration: 5.0}
  b: {speed: 3.0, avoid: {bands: [{from: 7.0, to: 8.0}, {from: 5.0, to: 7.5}]}}
systems:
  p: {model: spinning_pendulum, drive: a, parameters: {mass: 1.0, length: 1.0}}
)");
  const Json check = twin({"check", scene, "--json"}).json();
  const Json& a = check["drives"]["a"];
  EXPECT_DOUBLE_EQ(a["profile"][0]["duration"], 10.0 / 2.0 + 2.0 / 4.0);
  EXPECT_EQ(a["profile"][0]["dwell"], 1.5);
  EXPECT_DOUBLE_EQ(a["profile"][1]["duration"], 4.0);
  EXPECT_TRUE(a["profile"][1]["max_jerk"].is_null());
  EXPECT_DOUBLE_EQ(a["duration"], 5.5 + 1.5 + 4.0);
  EXPECT_EQ(check["drives"]["b"]["duration"], 0.0);
  EXPECT_TRUE(a["avoid"].empty());
  EXPECT_EQ(check["drives"]["b"]["avoid"], Json::parse(R"([{"from": 5.0, "to": 8.0}])"));
  EXPECT_NE(twin({"check", scene}).out.find("barred speeds 5 to 8 rad/s, in both directions"),
            std::string::npos);
}

TEST(Check, SaysWhichResonanceAMotorDoesNotPass) {
  const Ending end = twin({"check", "supervised_speed"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_NE(
      end.out.find("REFUSES the band from 180 to 220 rad/s: at 200 rad/s (1910 rpm) a steady whirl "
                   "needs 0.05 N m, but the motor has 0.012 N m"),
      std::string::npos)
      << end.out;
  const Json check = twin({"check", "supervised_speed", "--json"}).json();
  const auto weak = [&](const char* name) {
    const Json passages = check["controllers"][name]["weak_passages"];
    return passages.size() == 1 ? passages[0] : Json();
  };
  EXPECT_EQ(weak("sprinter")["refused"], false);
  EXPECT_EQ(weak("stubborn")["refused"], false);
  EXPECT_EQ(weak("prudent")["refused"], true);
  EXPECT_NEAR(weak("prudent")["needed"].get<double>(), 0.05, 1e-4);
  EXPECT_NEAR(check["controllers"]["sprinter"]["avoid"][0]["from"].get<double>(), 180.0, 0.1);
}

TEST(Check, ShowsOneSystemOnly) {
  const Json check = twin({"check", kDemo, "--system", "pendulum", "--json"}).json();
  ASSERT_EQ(check["systems"].size(), 1u);
  EXPECT_TRUE(check["systems"].contains("pendulum"));
}

TEST(Check, ReportIsForReaders) {
  const Ending end = twin({"check", kDemo});
  EXPECT_EQ(end.status, 0);
  for (const char* part : {"scene 'demo' is valid", "rotor: jeffcott_rotor",
                           "x (m), y (m): 4 states", "driven by shaft", "/twin/rotor/whirl",
                           "TWIN_ROTOR_WHIRL", "a step costs", "times faster than real time"}) {
    EXPECT_NE(end.out.find(part), std::string::npos) << part << "\n" << end.out;
  }
}

TEST(Check, ReportsAllErrorsOfAFileAtOnce) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.yaml", R"(
step: 20.0
gravty: 9.81
systems:
  rotor:
    model: jeffcott_rotor
    integrator: auto
    parameters: {mass: -1.0, stifness: 100.0, speed: nan}
  pendulum:
    model: spining_pendulum
)");
  const Ending end = twin({"check", scene});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  const Lines expected{
      scene + ": gravty: unknown key of a scene; did you mean 'gravity'?",
      scene + ": step: must be from 1e-09 to 10 s, found 20.0",
      scene +
          ": systems.rotor.parameters.stifness: unknown parameter of jeffcott_rotor; did you "
          "mean 'stiffness'?",
      scene + ": systems.rotor.parameters.mass: must be > 0 kg, found -1.0",
      scene + ": systems.rotor.parameters.stiffness: missing; must be > 0 N/m",
      scene + ": systems.rotor.parameters.speed: must be from -1e+06 to 1e+06 rad/s, found 'nan'",
      scene +
          ": systems.pendulum.model: must be the name of a model, found 'spining_pendulum'; "
          "did you mean 'spinning_pendulum'?"};
  EXPECT_EQ(linesOf(end.err), expected);
}

TEST(Check, RefusesWhatIsNoScene) {
  const TemporaryDirectory directory;
  struct Case {
    std::string path, error;
  };
  for (const Case& c :
       {Case{directory.file("none.yaml"), "no such file"}, Case{directory.file(""), "not a file"},
        Case{directory.write("empty.yaml", ""),
             "empty: a scene has a step and at least one system"},
        Case{directory.write("binary.yaml", std::string("a: \0", 4)),
             "a binary file, not a scene in YAML"}}) {
    const Ending end = twin({"check", c.path});
    EXPECT_EQ(end.status, 2);
    EXPECT_EQ(end.err, c.path + ": " + c.error + "\n");
  }
}

// Every lookup by name must be fast, or a file within the size limit takes minutes.
TEST(Check, LooksThroughAHundredThousandKeysInTime) {
  const TemporaryDirectory directory;
  std::string scene = "step: 0.001\nsystems:\n";
  for (int i = 0; i < 100000; ++i) {
    scene += "  a" + std::to_string(i) + ":\n";
  }
  const Ending end = twin({"check", directory.write("many.yaml", scene)});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(linesOf(end.err).back(), "and 99990 more");
}

// A scene that docs/scenes.md shows whole begins with its name.
TEST(Check, AcceptsTheScenesOfTheDocumentation) {
  const std::string page = contentsOf(WHIRL_TWIN_SOURCE "/docs/scenes.md");
  const TemporaryDirectory folder;
  int scenes = 0;
  for (std::size_t at = page.find("```yaml\nname: "); at != std::string::npos;
       at = page.find("```yaml\nname: ", at + 1)) {
    const std::size_t begin = at + std::string("```yaml\n").size();
    const std::string scene =
        folder.write("scene.yaml", page.substr(begin, page.find("```", begin) - begin));
    const Ending end = twin({"check", scene});
    EXPECT_EQ(end.status, 0) << end.err;
    ++scenes;
  }
  EXPECT_GE(scenes, 2);
}

}  // namespace check_command_test
}  // namespace whirl_twin
