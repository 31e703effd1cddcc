// A monitor and the twin that it watches have the same scene, whatever way it is written, or the
// monitor says where they differ.
#include "monitoring/watched_scene.h"

#include <gtest/gtest.h>

#include <sstream>

#include "scene/yaml_file.h"

namespace whirl_twin {
namespace watched_scene_test {

constexpr const char* kOwn = R"(
step: 0.001
systems:
  rotor: {model: jeffcott_rotor, parameters: {mass: 2.0, stiffness: 7200.0}}
)";

state::SceneText published(const std::string& yaml) {
  state::SceneText text;
  text.source = "field.yaml";
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    text.line.push_back(line);
  }
  return text;
}

WatchedScene sceneOfMonitor() {
  return {sceneLines(YAML::Load(kOwn)), "own.yaml"};
}

std::string another() {
  std::string text = kOwn;
  return text.replace(text.find("mass: 2.0"), 9, "mass: 3.0");
}

TEST(WatchedScene, TheSameSceneInOtherWordsIsTheSame) {
  WatchedScene scene = sceneOfMonitor();
  scene.take(
      published("systems:\n  rotor:\n    parameters:\n      stiffness: 7.2e3\n      mass: 2\n"
                "    model: jeffcott_rotor\nstep: 1e-3\n"),
      1);
  EXPECT_EQ(scene.mismatch(), "");
}

TEST(WatchedScene, AnotherSceneIsReportedWithWhereItDiffers) {
  WatchedScene scene = sceneOfMonitor();
  scene.take(published(another()), 1);
  EXPECT_NE(
      scene.mismatch().find("the scene of the twin (field.yaml) differs from that of the monitor "
                            "(own.yaml): systems.rotor.parameters.mass is 3 there, 2 here"),
      std::string::npos)
      << scene.mismatch();
  scene.take(published(kOwn), 1);
  EXPECT_EQ(scene.mismatch(), "");
}

TEST(WatchedScene, ASecondTwinsSceneIsOfNoAccount) {
  WatchedScene scene = sceneOfMonitor();
  scene.take(published(kOwn), 1);
  scene.take(published(another()), 1);
  EXPECT_EQ(scene.mismatch(), "");
  scene.follow(2);  // it has taken the place of the first
  EXPECT_NE(scene.mismatch(), "");
}

TEST(WatchedScene, WhatIsNoSceneIsReported) {
  for (const char* text : {"", "systems: [", "just words", "{systems: {}}"}) {
    WatchedScene scene = sceneOfMonitor();
    scene.take(published(text), std::nullopt);
    EXPECT_NE(scene.mismatch(), "") << text;
  }
}

}  // namespace watched_scene_test
}  // namespace whirl_twin
