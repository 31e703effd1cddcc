// Models that are not built in: when they are requested, and which are accepted.
#include <gtest/gtest.h>

#include <algorithm>

#include "../scene/scenes.h"
#include "models/model_registry.h"

namespace whirl_twin {
namespace model_source_test {

int asked = 0;
std::vector<std::string> warnings;

/// A copy of a built-in model under another name, and three that cannot be taken.
std::vector<ModelInfo> furtherModels() {
  ++asked;
  ModelInfo another = *findModel("jeffcott_rotor");
  another.name = "another_rotor";
  ModelInfo twin = another;
  twin.summary = "of the same name";
  ModelInfo nothing;
  nothing.name = "nothing";
  return {another, twin, *findModel("double_pendulum"), nothing};
}

std::string sceneWith(const std::string& model) {
  return "step: 0.001\nsystems: {it: {model: " + model +
         ", parameters: {mass: 1, stiffness: 100, speed: 5}}}";
}

// One test, for a source is asked once in the life of a program.
TEST(ModelSource, IsAskedOnceAndOnlyForWhatIsNotBuiltIn) {
  setModelSource(furtherModels, [](const std::string& text) { warnings.push_back(text); });

  const ModelInfo* rotor = findModel("jeffcott_rotor");
  EXPECT_EQ(sceneOf(sceneWith("jeffcott_rotor")).systems.front().model, "jeffcott_rotor");
  EXPECT_EQ(asked, 0) << "a scene of built-in models loads no plugin";

  EXPECT_EQ(sceneOf(sceneWith("another_rotor")).systems.front().model, "another_rotor");
  EXPECT_NE(findModel("another_rotor")->summary, "of the same name") << "the first has the name";
  EXPECT_EQ(findModel("unheard_of"), nullptr);
  EXPECT_EQ(findModel("nothing"), nullptr);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(findModel("jeffcott_rotor"), rotor) << "running twins keep pointers";

  const std::vector<std::string> names = modelNames();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(std::count(names.begin(), names.end(), "another_rotor"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "double_pendulum"), 1);

  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_NE(warnings[0].find("'another_rotor'"), std::string::npos);
  EXPECT_NE(warnings[1].find("'double_pendulum'"), std::string::npos);
  EXPECT_NE(warnings[2].find("'nothing'"), std::string::npos);
}

}  // namespace model_source_test
}  // namespace whirl_twin
