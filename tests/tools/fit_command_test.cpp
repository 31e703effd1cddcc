// `twin fit`: a study as a user writes it, its report, its errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "twin_program.h"

namespace whirl_twin {
namespace fit_command_test {

using testing::HasSubstr;

std::string scene(double inertia, double damping, double coulomb, double theta) {
  const auto text = [](double x) { return std::to_string(x); };
  return "name: rig\nstep: 0.001\nsystems:\n  arm:\n    model: pendulum\n    integrator: "
         "runge_kutta_4\n    parameters: {mass: 0.7, length: 0.5, inertia: " +
         text(inertia) + ", damping: " + text(damping) + ", coulomb: " + text(coulomb) +
         "}\n    initial: {theta: " + text(theta) + "}\n";
}

constexpr const char* kRuns =
    "scene: guess.yaml\nsystem: arm\nruns:\n"
    "  - {file: swing_1.csv, use: train, time: time, measured: {theta: arm.theta}}\n"
    "  - {file: swing_2.csv, use: validate, time: time, measured: {theta: arm.theta}}\n";

/// Two swings of one pendulum, as tables of `twin simulate`, and a scene with a wrong guess.
class Fit : public testing::Test {
 protected:
  Fit() {
    for (const auto& [name, theta] : {std::pair("1", 1.0), std::pair("2", -0.6)}) {
      const std::string truth = directory_.write("truth.yaml", scene(0.02, 0.03, 0.05, theta));
      const Ending end = twin({"simulate", truth, "--duration", "4", "--sample", "0.005",
                               "--output", directory_.file(std::string("swing_") + name + ".csv")});
      EXPECT_EQ(end.status, 0) << end.err;
    }
    directory_.write("guess.yaml", scene(0.03, 0.01, 0.01, 0.1));
  }
  Ending fit(const std::string& text, std::vector<std::string> options = {"--json"}) const {
    std::vector<std::string> arguments = {"fit", directory_.write("study.yaml", text)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return twin(arguments);
  }
  const TemporaryDirectory directory_;
};

TEST_F(Fit, FindsWhatTheRunsWereMadeWith) {
  const std::string study =
      std::string(kRuns) + "fit: {inertia: {min: 0.0}, damping: , coulomb: {min: 0.0}}\n";
  const Ending end = fit(study, {"--json", "--output", directory_.file("fitted.yaml"), "--plot",
                                 directory_.file("fit.json")});
  ASSERT_EQ(end.status, 0) << end.err;
  const nlohmann::json json = end.json();
  EXPECT_NEAR(json["parameters"]["inertia"]["value"], 0.02, 1e-6);
  EXPECT_NEAR(json["parameters"]["damping"]["value"], 0.03, 1e-6);
  EXPECT_NEAR(json["parameters"]["coulomb"]["value"], 0.05, 1e-6);
  EXPECT_LT(json["parameters"]["inertia"]["standard_deviation"], 1e-5);
  EXPECT_EQ(json["runs"]["swing_1.csv"]["use"], "train");
  EXPECT_LT(json["runs"]["swing_2.csv"]["rms"]["theta"], 1e-6);
  EXPECT_TRUE(json["undetermined"].empty());
  const YAML::Node system = YAML::LoadFile(directory_.file("fitted.yaml"))["systems"]["arm"];
  for (const auto& parameter : json["parameters"].items()) {
    EXPECT_NEAR(system["spread"][parameter.key()]["standard_deviation"].as<double>(),
                parameter.value()["standard_deviation"].get<double>(),
                0.01 * parameter.value()["standard_deviation"].get<double>())
        << parameter.key();
  }
  const YAML::Node together = system["spread"]["correlations"];
  ASSERT_EQ(together.size(), 3U);
  for (const YAML::Node& pair : together) {
    const auto reported = std::find_if(
        json["correlations"].begin(), json["correlations"].end(), [&](const nlohmann::json& other) {
          return other[0] == pair[0].as<std::string>() && other[1] == pair[1].as<std::string>();
        });
    ASSERT_NE(reported, json["correlations"].end());
    EXPECT_NEAR(pair[2].as<double>(), (*reported)[2].get<double>(), 1e-10);
  }
  EXPECT_EQ(twin({"analyze", directory_.file("fitted.yaml"), "--json"})
                .json()["systems"]["arm"]["spread_margin"]["members"],
            1000);
  // The scene that was written is one, with these values, and predicts without any fit.
  EXPECT_EQ(twin({"check", directory_.file("fitted.yaml")}).status, 0);
  const Ending again =
      fit("scene: fitted.yaml" +
              std::string(kRuns).substr(std::string("scene: guess.yaml").size()) + "fit: {}\n",
          {"--json", "--validate-only"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_LT(again.json()["runs"]["swing_1.csv"]["rms"]["theta"], 1e-6);
  EXPECT_THAT(contentsOf(directory_.file("fit_swing_2.json")), HasSubstr("validate"));
}

TEST_F(Fit, ValidateOnlyFindsStartsAlone) {
  const Ending end = fit(std::string(kRuns) + "fit: {}\n", {"--json", "--validate-only"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_TRUE(end.json()["parameters"].empty());
  EXPECT_GT(end.json()["runs"]["swing_1.csv"]["rms"]["theta"], 1e-3);  // a wrong guess
}

TEST_F(Fit, ChecksRunsWithoutAnyFit) {
  directory_.write("stuck.csv",
                   "time,q\n0.00,0.1\n0.01,0.2\n0.01,0.2\n0.02,0.3\n0.03,0.5\n0.50,0.4\n"
                   "0.51,0.2\n0.52,0.1\n0.53,0.0\n");
  const std::string study =
      std::string(kRuns) + "  - {file: stuck.csv, measured: {theta: q}}\nfit: {inertia: }\n";
  const Ending end = fit(study, {"--check"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("swing_1.csv: 801 rows, 4 s\n  no anomalies\n"));
  EXPECT_THAT(end.out, HasSubstr("stuck.csv: 8 rows, 0.53 s\n"));
  EXPECT_THAT(end.out, HasSubstr("gap"));
  const nlohmann::json json = fit(study, {"--check", "--json"}).json();
  EXPECT_TRUE(json["runs"]["swing_1.csv"]["remarks"].empty());
  EXPECT_FALSE(json["runs"]["stuck.csv"]["remarks"].empty());
  EXPECT_FALSE(json.contains("parameters"));
}

TEST_F(Fit, SaysWhatIsNotTold) {
  const Ending end = fit(std::string(kRuns) + "fit: {mass: , inertia: , damping: , coulomb: }\n");
  ASSERT_EQ(end.status, 0) << end.err;
  const nlohmann::json json = end.json();
  EXPECT_THAT(json["undetermined"], testing::SizeIs(4));
  EXPECT_TRUE(json["parameters"]["mass"]["standard_deviation"].is_null());
  EXPECT_THAT(json["directions"][0], HasSubstr("change together"));
  EXPECT_THAT(fit(std::string(kRuns) + "fit: {mass: , inertia: , damping: , coulomb: }\n", {}).out,
              HasSubstr("unidentifiable"));
}

/// Sensor data as recorded by an acquisition system beside the plant.
TEST_F(Fit, FitsALogOfWhatWasMeasured) {
  const std::string sensors =
      "sensors:\n  encoder: {rate: 200, channels: {theta: {measures: arm.theta, noise: 0.001}}}\n"
      "  other: {rate: 200, channels: {theta: {measures: arm.theta, noise: 0.1}}}\n";
  const std::string truth = directory_.write("truth.yaml", scene(0.02, 0.03, 0.05, 1.0) + sensors);
  const std::string log = directory_.file("swing.lcmlog");
  ASSERT_EQ(
      twin({"simulate", truth, "--duration", "4", "--measure", "sensors", "--output", log}).status,
      0);
  const auto study = [](const std::string& column) {
    return "scene: guess.yaml\nsystem: arm\nruns:\n  - {file: swing.lcmlog, measured: {theta: " +
           column + "}}\nfit: {inertia: {min: 0.0}, damping: , coulomb: {min: 0.0}}\n";
  };
  const nlohmann::json json = fit(study("encoder/theta")).json();
  for (const auto& [name, value] :
       {std::pair("inertia", 0.02), std::pair("damping", 0.03), std::pair("coulomb", 0.05)}) {
    const auto& reported = json["parameters"][name];
    EXPECT_NEAR(reported["value"].get<double>(), value,
                4.0 * reported["standard_deviation"].get<double>())
        << name;
  }
  EXPECT_NEAR(json["runs"]["swing.lcmlog"]["rms"]["theta"].get<double>(), 0.001, 1e-4);
  const Ending several = fit(study("theta"));
  EXPECT_EQ(several.status, 2);
  EXPECT_THAT(several.err, HasSubstr("of one source"));
  EXPECT_THAT(several.err, HasSubstr("found encoder/theta, other/theta"));
}

/// A measured pendulum, with the torque from the current of its motor.
class MeasuredTorque : public Fit {
 protected:
  MeasuredTorque() {
    std::string guess = scene(0.01, 0.001, 0.05, 0.0);
    guess.replace(guess.find("step: 0.001"), 11, "step: 0.002");
    guess.replace(guess.find("coulomb: "), 0, "coulomb_rate: 0.05, ");
    directory_.write("guess.yaml", guess);
  }
  nlohmann::json ofRecord(const std::string& name, const std::string& measured) const {
    const Ending end =
        fit("scene: guess.yaml\nsystem: arm\nruns:\n  - {file: " WHIRL_TWIN_SOURCE
            "/config/records/torque_limited_" +
            name + ".csv, measured: {theta: " + measured +
            "}, inputs: {torque: {column: torque, scale: fit, hold: true}}}\n"
            "fit: {mass: {min: 0.01}, inertia: {min: 0.0}, damping: {min: 0.0}, coulomb: {min: "
            "0.0}}\n");
    EXPECT_EQ(end.status, 0) << end.err;
    return end.json();
  }
};

/// A swing-up identifies its period, not its weight relative to the torque's scale.
TEST_F(MeasuredTorque, OfASwingUpTellsThePeriod) {
  const nlohmann::json reported = ofRecord("swing_up", "{column: theta, offset: fit}");
  const double mass = reported["parameters"]["mass"]["value"];
  const double inertia = reported["parameters"]["inertia"]["value"];
  EXPECT_NEAR((0.25 * mass + inertia) / (0.25 * mass), 1.0, 0.02) << "J/(m g l) beside l/g";
  for (const char* name : {"mass", "torque.scale"}) {
    EXPECT_THAT(reported["undetermined"], testing::Contains(name));
  }
  // The damping starts at a fifteenth of its true value: the mass must still be found.
  EXPECT_GT(mass, 0.25);
  EXPECT_LT(reported["runs"].begin().value()["rms"]["theta"].get<double>(), 5.0e-3);
}

/// Where its weight is balanced, and a hand moves it slowly, only the ratio of weight to torque is
/// identifiable, with a zero offset of the encoder or without; the others stay at their start
/// values.
TEST_F(MeasuredTorque, OfABalancedPendulumTellsNothing) {
  for (const char* measured : {"theta", "{column: theta, offset: fit}"}) {
    const nlohmann::json held = ofRecord("held", measured);
    for (const auto& [name, start] :
         {std::pair("mass", 0.7), std::pair("inertia", 0.01), std::pair("damping", 0.001),
          std::pair("torque.scale", 1.0)}) {
      EXPECT_THAT(held["undetermined"], testing::Contains(name)) << measured;
      EXPECT_NEAR(held["parameters"][name]["value"].get<double>(), start, 0.04 * start)
          << name << " of " << measured;
    }
    if (held["parameters"].contains("theta.offset")) {
      EXPECT_NEAR(held["parameters"]["theta.offset"]["value"].get<double>(), 0.0, 0.03);
    }
  }
}

/// The first swing with each line of numbers changed, or omitted.
class ChangedSwing : public Fit {
 protected:
  using Change = std::function<std::string(double time, double theta)>;  // "": omitted
  void write(const std::string& names, const Change& change) const {
    std::ifstream in(directory_.file("swing_1.csv"));
    std::ofstream out(directory_.file("changed.csv"));
    std::string line;
    std::getline(in, line);
    out << names << '\n';
    while (std::getline(in, line)) {
      out << change(std::stod(line), std::stod(line.substr(line.find(',') + 1)));
    }
  }
  Ending fitChanged(const std::string& column, const std::vector<std::string>& options) const {
    return fit(
        "scene: guess.yaml\nsystem: arm\nruns:\n  - {file: changed.csv, measured: {theta: '" +
            column + "'}}\nfit: {inertia: {min: 0.0}, damping: , coulomb: {min: 0.0}}\n",
        options);
  }
  static std::string row(double time, double theta) {
    return std::to_string(time) + "," + std::to_string(theta) + "\n";
  }
};

/// Half a second in which nothing was recorded, from the row at which a window ends.
TEST_F(ChangedSwing, WithAGapIsFitted) {
  write("time,q",
        [](double t, double theta) { return t > 1.0001 && t < 1.5 ? "" : row(t, theta); });
  const Ending end = fitChanged("q", {"--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_NEAR(end.json()["parameters"]["coulomb"]["value"], 0.05, 1e-3);
  EXPECT_THAT(end.json()["runs"]["changed.csv"]["remarks"][0], HasSubstr("1 gap"));
}

TEST_F(ChangedSwing, InAUnitThatItsColumnNamesIsTakenInIt) {
  write("time,q[deg]", [](double t, double theta) { return row(t, theta / 0.017453292519943295); });
  const Ending end = fitChanged("q[deg]", {"--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_NEAR(end.json()["parameters"]["damping"]["value"], 0.03, 1e-3);
}

/// Both runs are reported, with all of their names.
TEST_F(Fit, RefusesColumnsOfOneName) {
  directory_.write("swing_1.csv", "time,q,q,tau,tau\n0,1,2,3,4\n");
  directory_.write("swing_2.csv", "time,arm.theta,time\n0,1,2\n");
  const Ending end = fit(std::string(kRuns) + "fit: {inertia: }\n");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("swing_1.csv: line 1: column names must be unique; columns 2 and "
                                 "3 are named 'q'; columns 4 and 5 are named 'tau'\n"));
  EXPECT_THAT(
      end.err,
      HasSubstr(
          "swing_2.csv: line 1: column names must be unique; columns 1 and 3 are named 'time'\n"));
}

/// In one message, and nothing else on standard error.
TEST_F(ChangedSwing, ThatCannotBeUsedIsSaid) {
  const auto refused = [&](const std::string& column,
                           const std::vector<std::string>& options = {}) {
    const Ending end = fitChanged(column, options);
    EXPECT_EQ(end.status, 2) << end.err;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    return end.err;
  };
  write("time,q[mm]", row);
  EXPECT_THAT(refused("q[mm]", {"--check"}),
              HasSubstr("column 'q[mm]': the unit is mm, but theta must be in rad"));
  write("time,q", [](double t, double theta) { return row(t, 1.0e9 * theta); });
  EXPECT_THAT(refused("q", {"--check"}),
              HasSubstr("column 'q': theta must be within 1e+06 rad, found 1e+09 at 0 s"));
  write("time,q", [](double t, double) { return row(t, 0.3); });
  EXPECT_THAT(refused("q"), HasSubstr("the same values in every row"));
  write("time,q", [](double t, double theta) { return row(1000.0 * t, theta); });
  EXPECT_THAT(refused("q"), HasSubstr("rows are 5 s apart, so windows of 1 s have fewer than 5"));
}

TEST_F(ChangedSwing, ThatHardlyCanBeMeantIsRemarked) {
  const auto remark = [&] {
    const Ending end = fitChanged("q", {"--check"});
    EXPECT_EQ(end.status, 0) << end.err;
    return end.out;
  };
  write("time,q", [](double t, double theta) { return row(t, 57.3 * theta); });
  EXPECT_THAT(remark(), HasSubstr("turns: is it in degrees?"));
  write("time,q",
        [](double t, double theta) { return row(t, theta < 0.0 ? theta + 6.28 : theta); });
  EXPECT_THAT(remark(), HasSubstr("is a wrapped angle: 5 jumps of whole turns unwrapped"));
  write("time,q", [](double t, double theta) { return row(1000.0 * t, theta); });
  EXPECT_THAT(remark(),
              HasSubstr("rows are 5 s apart, 5e+03 steps of the scene: is the time in s?"));
}

TEST_F(Fit, TellsAllMistakesOfAStudyAtOnce) {
  const Ending end =
      fit("scene: guess.yaml\nsystem: arm\nruns:\n"
          "  - {file: swing_1.csv, use: trian, measured: {thet: arm.theta}}\n"
          "  - {file: nowhere.csv, measured: {theta: arm.theta}}\n"
          "  - {file: swing_2.csv, measured: {theta: arm.teta}, inputs: {force: f}}\n"
          "windows: {length: -1}\nfit: {mas: , damping: {min: 1, max: 0}}\nhubr: 1\n");
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  for (const char* said :
       {"runs[0].use: ",
        "runs[0].measured.thet: unknown coordinate or rate of the system; did you "
        "mean 'theta'?",
        "nowhere.csv: no such file", "runs[2].inputs.force: ", "windows.length: must be from 0.01",
        "fit.mas: ", "fit.damping: min must be < max", "hubr: "}) {
    EXPECT_THAT(end.err, HasSubstr(said));
  }
  EXPECT_THAT(fit("scene: none.yaml\nsystem: arm\nruns: []\nfit: {}\n").err,
              HasSubstr("none.yaml"));
  EXPECT_THAT(fit("scene: guess.yaml\nsystem: am\nruns: []\nfit: {}\n").err,
              HasSubstr("the scene has no 'am'; did you mean 'arm'?"));
  EXPECT_EQ(fit(std::string(kRuns) + "fit: {}\n").status, 2);
}

}  // namespace fit_command_test
}  // namespace whirl_twin
