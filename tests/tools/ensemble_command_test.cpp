// The output of `twin` for an ensemble.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "twin_program.h"

namespace whirl_twin {
namespace ensemble_command_test {

const char* const kScene = R"(
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 1, stiffness: 1.0e4, damping: 10, eccentricity: 1.0e-4, speed: 60}
    count: 21
    spread: {stiffness: {relative_half_width: 0.2}, initial.x: {half_width: 1.0e-5}}
  single:
    model: spinning_pendulum
    parameters: {mass: 0.5, length: 0.2, speed: 3}
    initial: {theta: 0.1}
)";

std::vector<double> column(const Lines& table, std::size_t place) {
  std::vector<double> values;
  for (std::size_t i = 1; i < table.size(); ++i) {
    std::istringstream row(table[i]);
    std::string field;
    for (std::size_t k = 0; k <= place; ++k) {
      std::getline(row, field, ',');
    }
    values.push_back(std::strtod(field.c_str(), nullptr));
  }
  return values;
}

TEST(EnsembleCommands, SimulateTellsStatisticsAndMembers) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("many.yaml", kScene);
  const Ending end = twin(
      {"simulate", scene, "--duration", "0.5", "--json", "--members", folder.file("members.csv")});
  ASSERT_EQ(end.status, 0) << end.err;
  const nlohmann::json ensemble = end.json()["systems"]["rotor"]["ensemble"];
  EXPECT_FALSE(end.json()["systems"]["single"].contains("ensemble"));
  EXPECT_EQ(ensemble["count"], 21);
  EXPECT_EQ(ensemble["running"], 21);
  const Lines table = linesOf(contentsOf(folder.file("members.csv")));
  ASSERT_EQ(table.size(), 1u + 21u);
  EXPECT_EQ(table[0], "member,stiffness,initial.x,radius,radius_peak");
  std::vector<double> radius = column(table, 3);
  std::sort(radius.begin(), radius.end());
  EXPECT_EQ(ensemble["radius"]["unit"], "m");
  EXPECT_EQ(ensemble["radius"]["median"], radius[10]);
  EXPECT_EQ(ensemble["radius"]["largest"], radius[20]);
  std::vector<double> peak = column(table, 4);
  EXPECT_EQ(ensemble["radius"]["peak"]["largest"], *std::max_element(peak.begin(), peak.end()));
  for (const double stiffness : column(table, 1)) {
    EXPECT_GE(stiffness, 0.8e4);
    EXPECT_LE(stiffness, 1.2e4);
  }
}

TEST(EnsembleCommands, MembersNeedOneEnsemble) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("many.yaml", kScene);
  const Ending other = twin({"simulate", scene, "--system", "single", "--duration", "0.1", "--json",
                             "--members", folder.file("members.csv")});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("--members: needs one system with a count, found 0"), std::string::npos)
      << other.err;
  const Ending name = twin({"simulate", scene, "--members", folder.file("members.txt")});
  EXPECT_EQ(name.status, 2);
  EXPECT_NE(name.err.find("--members: must end in .csv"), std::string::npos) << name.err;
  EXPECT_EQ(folder.files(), Lines{"many.yaml"});
}

TEST(EnsembleCommands, CheckSaysHowItIsStepped) {
  const TemporaryDirectory folder;
  const Ending end = twin({"check", folder.write("many.yaml", kScene), "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const nlohmann::json rotor = end.json()["systems"]["rotor"];
  EXPECT_EQ(rotor["ensemble"], "21 samples, side by side in vectors");
  EXPECT_EQ(rotor["topics"][5], nlohmann::json({{"topic", "/twin/rotor/ensemble"},
                                                {"type", "whirl_twin/EnsembleState"}}));
  EXPECT_EQ(rotor["channels"][4], "TWIN_ROTOR_ENSEMBLE");
  const std::string many = std::string(kScene).replace(std::string(kScene).find("21"), 2, "9021");
  const Ending larger = twin({"check", folder.write("more.yaml", many), "--json"});
  if (::mallinfo2().uordblks > 0) {  // a sanitizer's memory is not counted
    EXPECT_GT(larger.json()["systems"]["rotor"]["memory_bytes"].get<double>() -
                  rotor["memory_bytes"].get<double>(),
              9000.0 * 200.0)
        << "its matrices and sums alone";
  }
  EXPECT_FALSE(end.json()["systems"]["single"].contains("ensemble"));
  EXPECT_EQ(end.json()["threads"], 3);
}

TEST(EnsembleCommands, PlotDrawsThem) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("many.yaml", kScene);
  const TemporaryDirectory pictures;
  const Ending end = twin({"plot", scene, "--duration", "0.5", "--system", "rotor", "--format",
                           "json", "--output", pictures.file("")});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(pictures.files(), (Lines{"rotor_energy.json", "rotor_ensemble.json", "rotor_phase.json",
                                     "rotor_time.json"}));
  const std::string svg = contentsOf(pictures.file("rotor_ensemble.json"));
  EXPECT_NE(svg.find("5 to 95 %"), std::string::npos);
  EXPECT_NE(svg.find("samples over largest radius of a sample (m)"), std::string::npos);
}

TEST(EnsembleCommands, TheLogHasThem) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("many.yaml", kScene);
  const std::string log = folder.file("run.lcmlog");
  ASSERT_EQ(twin({"simulate", scene, "--duration", "0.5", "--output", log}).status, 0);
  const Ending end = twin({"log", log, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const nlohmann::json found = end.json();
  EXPECT_EQ(found["corrupt"], 0);
  const nlohmann::json channel = found["channels"]["TWIN_ROTOR_ENSEMBLE"];
  EXPECT_EQ(channel["events"], 26) << "at the start and every 20 ms";
  EXPECT_EQ(channel["rejected"], 0);
}

}  // namespace ensemble_command_test
}  // namespace whirl_twin
