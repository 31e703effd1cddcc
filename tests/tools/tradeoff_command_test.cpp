// twin tradeoff: reliable rows, and files only when they are complete.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "twin_program.h"

namespace whirl_twin {
namespace tradeoff_command_test {

using Json = nlohmann::json;

constexpr const char* kTwo = R"(
name: two
step: 0.002
drives: {shaft: {speed: 4.0}}
systems:
  rotor: {model: jeffcott_rotor, drive: shaft, tolerance: 1.0e-4, horizon: 1.0,
    parameters: {mass: 1, stiffness: 100, damping: 0.4, eccentricity: 0.001}, initial: {x: 0.01}}
  swing: {model: spinning_pendulum, drive: shaft, horizon: 1.0,
    parameters: {mass: 1, length: 1}, initial: {theta: 0.7}}
)";

TEST(Tradeoff, ErrorsFallWithTheOrderAndTheRecommendedRowKeepsTheTolerance) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("two.yaml", kTwo);
  const Ending end = twin({"tradeoff", scene, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json report = Json::parse(end.out);
  const std::map<std::string, int> orders{{"semi_implicit_euler", 1}, {"velocity_verlet", 2},
                                          {"implicit_midpoint", 2},   {"runge_kutta_4", 4},
                                          {"gauss_legendre_4", 4},    {"gauss_legendre_6", 6}};
  std::map<std::string, std::vector<Json>> rows;
  for (const Json& row : report["rows"]) {
    for (const char* key :
         {"integrator", "step", "substeps", "error", "ns_per_step", "cpu_per_simulated_second",
          "real_time_factor", "energy_drift", "stable", "pareto"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
    // [ns] per step, relative to the step.
    const double cpu = 1e-9 * row["ns_per_step"].get<double>() / row["step"].get<double>();
    EXPECT_NEAR(row["cpu_per_simulated_second"].get<double>(), cpu, 1e-9 * cpu);
    rows[row["system"].get<std::string>() + "/" + row["integrator"].get<std::string>()].push_back(
        row);
  }
  EXPECT_EQ(rows.count("rotor/exponential"), 1u);
  EXPECT_EQ(rows.count("swing/exponential"), 0u);
  EXPECT_EQ(rows.count("swing/dormand_prince_8"), 1u);
  for (const auto& [method, order] : orders) {
    for (const char* system : {"rotor/", "swing/"}) {
      const std::vector<Json>& ladder = rows.at(system + method);
      // From the scene's step to half of it: p h is 0.02 and 0.006.
      for (std::size_t i = 0; i + 1 < ladder.size(); ++i) {
        const double coarse = ladder[i]["error"];
        const double fine = ladder[i + 1]["error"];
        if (ladder[i]["step"] == 0.002 && ladder[i]["substeps"] == 1 && fine > 1e-12) {
          EXPECT_NEAR(std::log2(coarse / fine), order, 0.3) << system << method;
        }
        EXPECT_GE(ladder[i]["worst_error"].get<double>(), fine) << "a level counts only with all";
      }
    }
  }
  for (const Json& best : report["recommended"]) {
    for (const Json& row : report["rows"]) {
      const double own = best["reference"]["error"];
      if (row["system"] == best["system"]) {
        EXPECT_GE(row["error"].get<double>(), own) << "no better known than the reference is";
        if (row["below_reference"].get<bool>()) {
          EXPECT_EQ(row["error"].get<double>(), own);
        }
      }
    }
    EXPECT_NE(best["reference"]["checked_by"], nullptr);
    EXPECT_LE(best["error"].get<double>(), best["tolerance"].get<double>());
    EXPECT_EQ(best["step"].get<double>(), 0.002);
    EXPECT_LT(best["reference"]["error"].get<double>(), 1e-9);
    EXPECT_EQ(best["compared_until"].get<double>(), best["duration"].get<double>());
  }
  ASSERT_EQ(report["recommended"].size(), 2u);
  EXPECT_EQ(report["recommended"][0]["auto"], "exponential, 1 per step");
  EXPECT_NEAR(report["recommended"][0]["largest_stable_step"]["semi_implicit_euler"].get<double>(),
              0.064, 1e-12)
      << "the coarsest that is tried: far below 2 / p";
}

TEST(Tradeoff, WritesItsTableAndItsPicture) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("two.yaml", kTwo);
  const Ending end = twin({"tradeoff", scene, "--system", "swing", "--output",
                           directory.file("rows.csv"), "--plot", directory.file("rows.json")});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_NE(end.out.find("<- recommended"), std::string::npos) << end.out;
  const std::vector<std::string> lines = linesOf(contentsOf(directory.file("rows.csv")));
  EXPECT_EQ(lines.front().substr(0, 32), "system,integrator,step,substeps,");
  EXPECT_GT(lines.size(), 40u);
  EXPECT_EQ(contentsOf(directory.file("rows.json")).substr(0, 8), "{\"kind\":");
}

TEST(Tradeoff, DrawsEachMethodInAColourOfItsOwnAndNamesItOnce) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("two.yaml", kTwo);
  const Ending end = twin({"tradeoff", scene, "--system", "swing", "--duration", "0.2", "--json",
                           "--plot", directory.file("rows.json")});
  ASSERT_EQ(end.status, 0) << end.err;
  std::set<std::string> methods;
  const Json report = Json::parse(end.out);
  for (const Json& row : report["rows"]) {
    methods.insert(row["integrator"].get<std::string>());
  }
  ASSERT_GE(methods.size(), 8u);
  const Json figure = Json::parse(contentsOf(directory.file("rows.json")));
  const std::string words = figure["description"];
  for (const std::string& method : methods) {
    const std::regex name("\\b" + method + "\\b");
    EXPECT_EQ(std::distance(std::sregex_iterator(words.begin(), words.end(), name), {}), 1)
        << method;
  }
  std::set<std::string> colours;
  for (const Json& series : figure["charts"][0]["series"]) {
    if (!series["pen"].is_null()) {
      colours.insert(series["pen"]["color"].get<std::string>());
    }
  }
  EXPECT_GE(colours.size(), methods.size());
}

TEST(Tradeoff, FollowsAConservedMomentumAsTheMethodsOrderLetsIt) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("hub.yaml", R"(
name: hub
step: 0.01
systems:
  hub: {model: rotating_pendulum, horizon: 2.0,
    parameters: {mass: 1, length: 1, hub_inertia: 0.2}, initial: {theta: 0.8, phi_rate: 3.0}}
)");
  const Ending end = twin({"tradeoff", scene, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  std::map<std::string, std::vector<double>> drifts;  // from 0.01 s to a quarter
  const Json report = Json::parse(end.out);
  for (const Json& row : report["rows"]) {
    if (row["step"] == 0.01 && row["substeps"].get<int>() <= 4) {
      drifts[row["integrator"]].push_back(row["momentum_drift"].get<double>());
    }
  }
  EXPECT_NEAR(std::log2(drifts.at("velocity_verlet")[0] / drifts.at("velocity_verlet")[1]), 2, 0.3);
  EXPECT_NEAR(std::log2(drifts.at("runge_kutta_4")[0] / drifts.at("runge_kutta_4")[1]), 4, 1.1);
  EXPECT_LT(drifts.at("gauss_legendre_6")[0], 1e-9);
}

TEST(Tradeoff, SaysHowFarAChaoticMotionIsCompared) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("chaos.yaml", R"(
name: chaos
step: 0.004
systems:
  rods: {model: double_pendulum, horizon: 20.0,
    parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}, initial: {theta1: 2.0, theta2: 2.5}}
)");
  const Ending end = twin({"tradeoff", scene, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json best = Json::parse(end.out)["recommended"][0];
  EXPECT_LT(best["compared_until"].get<double>(), best["duration"].get<double>());
  EXPECT_GT(best["compared_until"].get<double>(), 2.0);
  EXPECT_GT(best["disturbance_growth"].get<double>(), 1e4);
}

TEST(Tradeoff, RefusesNamesOfFilesAndDurationsItCannotMean) {
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--output", "rows.txt"},
                                                        {"--plot", "rows.gif"},
                                                        {"--duration", "-1"},
                                                        {"--system", "none"}}) {
    const Ending end = twin({"tradeoff", "demo", option, value});
    EXPECT_EQ(end.status, 2) << option;
    EXPECT_EQ(end.out, "");
    EXPECT_NE(end.err.find(value), std::string::npos) << end.err;
  }
}

}  // namespace tradeoff_command_test
}  // namespace whirl_twin
