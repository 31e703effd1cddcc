// `twin scenes`, and scenes named as roslaunch names them.
#include <gtest/gtest.h>

#include <set>

#include "twin_program.h"

namespace whirl_twin {
namespace scenes_command_test {

using Json = nlohmann::json;

TEST(Scenes, EveryModelOfTheProgramIsInAShippedSceneThatSaysWhatToWatch) {
  const Ending end = twin({"scenes", "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  std::set<std::string> shown;
  const nlohmann::json scenes = end.json()["scenes"];
  ASSERT_FALSE(scenes.empty());
  for (const auto& [name, scene] : scenes.items()) {
    EXPECT_TRUE(scene["refusal"].is_null()) << name << ": " << scene["refusal"];
    EXPECT_GT(scene["about"].get<std::string>().size(), 20u) << name;
    EXPECT_GT(scene["watch"].get<std::string>().size(), 20u) << name;
    for (const auto& [system, model] : scene["systems"].items()) {
      shown.insert(model.get<std::string>());
    }
  }
  const Ending models = twin({"models", "--json"});
  const nlohmann::json all = models.json()["models"];
  ASSERT_FALSE(all.empty());
  for (const auto& [model, info] : all.items()) {
    EXPECT_EQ(shown.count(model), 1u) << "no scene shows " << model;
  }
}

TEST(Scenes, TheListNamesSystemsModelsAndWhatToWatch) {
  const Ending end = twin({"scenes"});
  ASSERT_EQ(end.status, 0);
  EXPECT_NE(end.out.find("\nrod_slider\n"), std::string::npos);
  EXPECT_NE(end.out.find("systems: rod (rod_slider)"), std::string::npos);
  const std::string watch = twin({"scenes", "--json"}).json()["scenes"]["rod_slider"]["watch"];
  EXPECT_NE(end.out.find("\n  " + watch + "\n"), std::string::npos);
}

TEST(Scenes, OfAFolderIncludeThoseThatCannotBeRead) {
  const TemporaryDirectory directory;
  directory.write("good.yaml",
                  "# A hanging pendulum.\n#\n# Watch it.\nstep: 0.01\nsystems: {p: {model: "
                  "double_pendulum, parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}}}\n");
  directory.write("bad.yaml", "step: -1\n");
  directory.write("notes.txt", "no scene\n");
  const Ending end = twin({"scenes", directory.file(""), "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json scenes = end.json()["scenes"];
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes["good"]["about"], "A hanging pendulum.");
  EXPECT_EQ(scenes["good"]["watch"], "Watch it.");
  EXPECT_NE(scenes["bad"]["refusal"].get<std::string>().find("step"), std::string::npos);
  EXPECT_EQ(twin({"scenes", directory.file("none")}).status, 2);
}

TEST(Scenes, AreShownAsTheyAreWritten) {
  const Ending shown = twin({"scenes", "--show", "rod_slider"});
  ASSERT_EQ(shown.status, 0) << shown.err;
  EXPECT_EQ(shown.out, contentsOf(WHIRL_TWIN_SOURCE "/config/scenes/rod_slider.yaml"));
  const TemporaryDirectory folder;
  EXPECT_EQ(twin({"check", folder.write("mine.yaml", shown.out)}).status, 0);
  EXPECT_EQ(twin({"scenes", "--show", "rod_slider", "--json"}).json()["text"], shown.out);

  const Ending none = twin({"scenes", "--show", "rod_slidr"});
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(none.err, "twin: --show: no scene 'rod_slidr'; did you mean 'rod_slider'?\n");
}

TEST(Scenes, AreTakenByNameByEveryCommandThatReadsOne) {
  EXPECT_EQ(twin({"check", "rod_slider"}).status, 0);
  EXPECT_EQ(twin({"analyze", "rod_slider", "--json"}).status, 0);
  EXPECT_EQ(twin({"simulate", "rod_slider", "--duration", "0.01", "--json"}).status, 0);
  const Ending end = twin({"check", "rod_sliders"});
  EXPECT_EQ(end.status, 2);
  EXPECT_NE(end.err.find("rod_sliders: no such file"), std::string::npos) << end.err;
}

}  // namespace scenes_command_test
}  // namespace whirl_twin
