// `twin follow`: state estimation from a log or a table of measurements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "twin_program.h"

namespace whirl_twin {
namespace follow_command_test {

using Json = nlohmann::json;

constexpr const char* kArm = R"(name: rig
step: 0.001
systems:
  arm:
    model: pendulum
    parameters: {mass: 0.5, length: 0.3, damping: 0.004}
    initial: {theta: 1.2}
sensors:
  encoder:
    rate: 200.0
    channels:
      theta: {measures: arm.theta, noise: 0.002}
)";

class FollowedArm : public testing::Test {
 protected:
  FollowedArm() {
    const Ending end = twin({"simulate", scene_, "--duration", "10", "--sample", "0.005",
                             "--measure", "sensors", "--output", log_});
    EXPECT_EQ(end.status, 0) << end.err;
  }
  std::string other() const {
    std::string text = kArm;
    text.replace(text.find("length: 0.3,"), 12, "length: 0.31,");
    return directory_.write("other.yaml", text);
  }

  const TemporaryDirectory directory_;
  const std::string scene_ = directory_.write("arm.yaml", kArm);
  const std::string log_ = directory_.file("arm.lcmlog");
};

TEST_F(FollowedArm, TellsWhatTheMachineIs) {
  const std::string settings =
      directory_.write("follow.yaml", "systems: {arm: {parameters: {length: 0.05}}}\n");
  const std::string output = directory_.file("twin.lcmlog");
  const Ending end =
      twin({"follow", other(), log_, "--settings", settings, "--json", "--output", output});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json arm = end.json()["systems"]["arm"];
  EXPECT_TRUE(arm["found"]);
  EXPECT_NEAR(arm["parameters"]["length"]["value"].get<double>(), 0.3, 3.0e-4);
  EXPECT_NEAR(arm["channels"]["encoder/theta"]["residual_rms"].get<double>(), 0.002, 2.0e-4);
  EXPECT_EQ(arm["samples"]["refused"], 0);
  EXPECT_TRUE(arm["drift"].is_null());

  // Its log is that of a twin, with measurements and estimates.
  const Ending log = twin({"log", output});
  ASSERT_EQ(log.status, 0) << log.err;
  for (const char* name : {"TWIN_ARM_PENDULUM", "TWIN_ARM_FOLLOW", "TWIN_ENCODER_MEASUREMENT"}) {
    EXPECT_NE(log.out.find(name), std::string::npos) << name << " in\n" << log.out;
  }
  // A second run on the recorded measurements gives the same.
  const Ending again = twin({"follow", other(), output, "--settings", settings, "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.json()["systems"], end.json()["systems"]);
}

TEST_F(FollowedArm, ATableIsFollowedAsWell) {
  const std::string table = directory_.file("run.csv");
  ASSERT_EQ(twin({"simulate", scene_, "--duration", "5", "--sample", "0.005", "--output",
                  directory_.file("motion.csv")})
                .status,
            0);
  // time,arm.theta,... : its angle as the column of the channel
  std::ifstream motion(directory_.file("motion.csv"));
  std::ofstream out(table);
  out << "time,theta\n";
  std::string line;
  std::getline(motion, line);
  while (std::getline(motion, line)) {
    const std::size_t second = line.find(',', line.find(',') + 1);
    out << line.substr(0, second) << '\n';
  }
  out.close();
  const Ending end = twin({"follow", scene_, table, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_LT(end.json()["systems"]["arm"]["channels"]["encoder/theta"]["residual_rms"].get<double>(),
            1.0e-3);
}

// A pendulum that goes over the top for two seconds, its encoder counting within a turn.
TEST_F(FollowedArm, AnEncoderThatCountsWithinATurnIsFollowedOverTheTop) {
  std::string text = kArm;
  text.replace(text.find("{theta: 1.2}"), 12, "{theta: 1.2, theta_rate: 16.0}");
  const std::string machine = directory_.write("machine.yaml", text);
  const std::string motion = directory_.file("over.csv");
  ASSERT_EQ(twin({"simulate", machine, "--duration", "10", "--sample", "0.005", "--output", motion})
                .status,
            0);
  std::ifstream file(motion);
  std::string line, table = "time,theta\n";
  std::getline(file, line);
  double farthest = 0.0;
  while (std::getline(file, line)) {
    const double time = std::stod(line), theta = std::stod(line.substr(line.find(',') + 1));
    farthest = std::max(farthest, std::fabs(theta));
    table += std::to_string(time) + "," + std::to_string(std::remainder(theta, 6.283185307179586)) +
             "\n";
  }
  ASSERT_GT(farthest, 12.0);  // two turns at least
  const std::string settings =
      directory_.write("follow.yaml", "systems: {arm: {parameters: {length: 0.05}}}\n");
  const Ending end = twin({"follow", other(), directory_.write("wrapped.csv", table), "--settings",
                           settings, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json arm = end.json()["systems"]["arm"];
  EXPECT_NEAR(arm["parameters"]["length"]["value"].get<double>(), 0.3, 1.0e-3);
  EXPECT_LT(arm["samples"]["refused"].get<int>(), 20);
}

TEST_F(FollowedArm, ATableWithTwoColumnsOfOneNameIsRefused) {
  const std::string table = directory_.write("twice.csv", "time,theta,theta\n0,0.1,0.2\n");
  const Ending end = twin({"follow", scene_, table});
  EXPECT_EQ(end.status, 2);
  EXPECT_NE(
      end.err.find(
          "twice.csv: line 1: column names must be unique; columns 2 and 3 are named 'theta'"),
      std::string::npos)
      << end.err;
}

/// A torque that acts on the arm, in a separate column, declared in the settings.
TEST_F(FollowedArm, AColumnOfATableActsOnAnInput) {
  const std::string motion = directory_.file("driven.csv");
  const std::string driven = directory_.write(
      "driven.yaml",
      std::string(kArm).replace(std::string(kArm).find("    initial:"), 0,
                                "    inputs: {torque: {amplitude: 0.4, frequency: 7.3}}\n"));
  ASSERT_EQ(
      twin({"simulate", driven, "--duration", "5", "--sample", "0.005", "--output", motion}).status,
      0);
  std::ifstream in(motion);
  const std::string table = directory_.file("table.csv");
  std::ofstream out(table);
  out << "time,theta,tau\n";
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const std::size_t second = line.find(',', line.find(',') + 1);
    out << line.substr(0, second) << ',' << 200.0 * std::cos(7.3 * std::stod(line)) << '\n';
  }
  out.close();
  const std::string settings = directory_.write(
      "inputs.yaml", "systems: {arm: {inputs: {torque: {channel: encoder/tau, scale: 0.002}}}}\n");
  const Ending end = twin({"follow", scene_, table, "--settings", settings, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json arm = end.json()["systems"]["arm"];
  EXPECT_LT(arm["channels"]["encoder/theta"]["residual_rms"].get<double>(), 1.0e-3);
  EXPECT_EQ(arm["samples"]["refused"], 0);
  EXPECT_FALSE(arm["channels"].contains("encoder/tau"));
  const Ending without = twin({"follow", scene_, table, "--json"});
  ASSERT_EQ(without.status, 0) << without.err;
  EXPECT_GT(without.json()["restarts"].get<int>(), 0);
}

TEST_F(FollowedArm, AMotionTooShortForResidualsHasNone) {
  const std::string log = directory_.file("short.lcmlog");
  ASSERT_EQ(
      twin({"simulate", scene_, "--duration", "0.15", "--measure", "sensors", "--output", log})
          .status,
      0);
  const Ending text = twin({"follow", scene_, log});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("no residual"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("nan"), std::string::npos) << text.out;
  const Json reported = twin({"follow", scene_, log, "--json"}).json()["systems"]["arm"];
  EXPECT_TRUE(reported["found"]);
  EXPECT_TRUE(reported["channels"]["encoder/theta"]["residual_rms"].is_null());
}

TEST_F(FollowedArm, WhatIsWrongIsSaidAtItsPlaceAllAtOnce) {
  const std::string settings = directory_.write("follow.yaml", R"(systems:
  arm:
    parameters: {lenght: 0.05, inertia: 0.1}
    offsets: {encoder/tetha: 0.1}
    unbalance: 1.0e-3
    disturbance: -1
  leg: {}
patience: 100
)");
  const Ending end = twin({"follow", scene_, log_, "--settings", settings});
  EXPECT_EQ(end.status, 2);
  for (const char* part :
       {"lenght", "did you mean 'length'", "inertia: must start from a nonzero value in the scene",
        "encoder/tetha", "unbalance: needs a rotor", "disturbance", "leg", "patience"}) {
    EXPECT_NE(end.err.find(part), std::string::npos) << part << " in\n" << end.err;
  }
}

TEST_F(FollowedArm, NothingToFollowIsSaid) {
  const std::string silent = directory_.file("silent.lcmlog");
  ASSERT_EQ(twin({"simulate", scene_, "--duration", "1", "--output", silent}).status, 0);
  const Ending empty = twin({"follow", scene_, silent});
  EXPECT_EQ(empty.status, 2);
  EXPECT_NE(empty.err.find("found none"), std::string::npos) << empty.err;
  const Ending none = twin({"follow", scene_, directory_.file("nothing.lcmlog")});
  EXPECT_EQ(none.status, 2);
  const std::string blind = directory_.write(
      "blind.yaml", std::string(kArm).substr(0, std::string(kArm).find("sensors")));
  const Ending unseen = twin({"follow", blind, log_});
  EXPECT_EQ(unseen.status, 2);
  EXPECT_NE(unseen.err.find("sensors"), std::string::npos) << unseen.err;
}

}  // namespace follow_command_test
}  // namespace whirl_twin
