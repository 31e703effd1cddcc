// What a follower is told: the same from a file and from a parameter server.
#include "estimation/follow_settings_reader.h"

#include <gtest/gtest.h>

#include <string>

#include "messages/refusal.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace {

FollowSettings settingsOf(const std::string& offsets) {
  static const BuiltScene scene = build(readScene(YAML::Load(R"(
name: rig
step: 0.001
systems:
  pendulum:
    model: pendulum
    parameters: {mass: 1.0, length: 0.5}
sensors:
  encoders: {rate: 500.0, channels: {theta: {measures: pendulum.theta, noise: 1.0e-4}}}
)"),
                                                  "a test"));
  return readFollowSettings(YAML::Load("systems: {pendulum: {offsets: " + offsets + "}}"), "a test",
                            scene);
}

TEST(FollowSettings, TakesZerosByPathAndNestedAsAParameterServerHasThem) {
  for (const char* offsets : {"{encoders/theta: 0.02}", "{encoders: {theta: 0.02}}"}) {
    const FollowSettings settings = settingsOf(offsets);
    EXPECT_EQ(settings.of("pendulum").offset.at("encoders/theta"), 0.02) << offsets;
  }
  for (const char* offsets : {"{encoders: 0.02}", "{encoders: {phi: 0.02}}", "{rig: {theta: 0.02}}",
                              "{encoders: {theta: -1.0}}", "{encoders: {theta: {a: 1.0}}}",
                              "{encoders/phi: 0.02}", "0.02", "[0.02]"}) {
    EXPECT_THROW(settingsOf(offsets), Refusal) << offsets;
  }
}

}  // namespace
}  // namespace whirl_twin
