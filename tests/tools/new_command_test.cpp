// `twin new`: a valid scene of every model, with all its optional keys.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace new_command_test {

using Json = nlohmann::json;

/// A line of YAML `key:`, set or behind a #.
bool names(const std::string& scene, const std::string& key) {
  for (std::string line : linesOf(scene)) {
    line.erase(0, line.find_first_not_of(" #"));
    if (line.compare(0, key.size() + 1, key + ":") == 0) {
      return true;
    }
  }
  return false;
}

TEST(New, WritesASoundSceneOfEveryModelWithEveryKey) {
  const TemporaryDirectory folder;
  const Json models = twin({"models", "--json"}).json()["models"];
  for (const auto& [name, model] : models.items()) {
    const Ending written = twin({"new", name});
    ASSERT_EQ(written.status, 0) << written.err;
    const std::string file = folder.write(name + ".yaml", written.out);
    const Ending checked = twin({"check", file, "--json"});
    EXPECT_EQ(checked.status, 0) << name << "\n" << checked.err << written.out;
    const Json parameters = model.value("parameters", Json::object());
    for (const auto& [parameter, info] : parameters.items()) {
      EXPECT_TRUE(parameter == "speed" || names(written.out, parameter))
          << name << ": " << parameter;
    }
    const Json settings = model.value("settings", Json::object());
    for (const auto& [setting, info] : settings.items()) {
      EXPECT_TRUE(names(written.out, setting)) << name << ": " << setting;
    }
    const Json inputs = model.value("inputs", Json::object());
    for (const auto& [input, info] : inputs.items()) {
      EXPECT_TRUE(names(written.out, input)) << name << ": " << input;
    }
    for (const char* key :
         {"integrator", "tolerance", "horizon", "substeps", "initial", "gravity"}) {
      EXPECT_TRUE(names(written.out, key)) << name << ": " << key;
    }
  }
}

TEST(New, SaysUnitsRangesAndDefaults) {
  const std::string scene = twin({"new", "jeffcott_rotor"}).out;
  EXPECT_NE(scene.find("kg, > 0: "), std::string::npos) << scene;
  EXPECT_NE(scene.find("# internal_damping: 0"), std::string::npos) << scene;
  EXPECT_NE(scene.find("# tolerance: 1.0e-6"), std::string::npos);
  EXPECT_NE(scene.find("drive: shaft"), std::string::npos);
}

TEST(New, OfNoModelSaysWhichThereAre) {
  const Ending end = twin({"new", "jeffcot_rotor"});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.err, "twin: no model 'jeffcot_rotor'; did you mean 'jeffcott_rotor'?\n");
}

}  // namespace new_command_test
}  // namespace whirl_twin
