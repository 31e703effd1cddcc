// Settings of the state estimator: the same from a file and from a parameter server.
#include <gtest/gtest.h>

#include <string>

#include "estimation/follow_settings.h"
#include "messages/input_error.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace follow_settings_reader_test {

FollowSettings settingsOf(const std::string& pendulum) {
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
  return readFollowSettings(YAML::Load("systems: {pendulum: {" + pendulum + "}}"), "a test", scene);
}

TEST(FollowSettings, TakesZerosByPathAndNestedAsAParameterServerHasThem) {
  for (const char* offsets : {"{encoders/theta: 0.02}", "{encoders: {theta: 0.02}}"}) {
    const FollowSettings settings = settingsOf(std::string("offsets: ") + offsets);
    EXPECT_EQ(settings.of("pendulum").offset.at("encoders/theta"), 0.02) << offsets;
  }
  for (const char* offsets :
       {"{encoders: 0.02}", "{encoders: {phi: 0.02}}", "{rig: {theta: 0.02}}",
        "{encoders: {theta: -1.0}}", "{encoders: {theta: {a: 1.0}}}", "{encoders/phi: 0.02}",
        "{encoders/theta: 1.0e300}", "0.02", "[0.02]"}) {
    EXPECT_THROW(settingsOf(std::string("offsets: ") + offsets), InputError) << offsets;
  }
}

TEST(FollowSettings, TakesAMeasuredInputByItsChannel) {
  const InputFollowing plain = settingsOf("inputs: {torque: motor/tau}").of("pendulum").inputs[0];
  EXPECT_EQ(plain.source + "/" + plain.channel, "motor/tau");
  EXPECT_EQ(plain.unit, "N m");
  EXPECT_EQ(plain.scale, 1.0);
  EXPECT_FALSE(plain.hold);
  const InputFollowing all =
      settingsOf(
          "inputs: {torque: {channel: encoders/tau, scale: -0.5, offset: 0.1, "
          "deviation: 0.02, hold: true}}")
          .of("pendulum")
          .inputs[0];
  EXPECT_EQ(all.source, "encoders");
  EXPECT_EQ(all.scale, -0.5);
  EXPECT_EQ(all.offset, 0.1);
  EXPECT_EQ(all.deviation, 0.02);
  EXPECT_TRUE(all.hold);
  for (const char* wrong :
       {"{force: motor/tau}", "{torque: tau}", "{torque: motor/}", "{torque: encoders/theta}",
        "{torque: {scale: 2.0}}", "{torque: {channel: motor/tau, hold: maybe}}",
        "{torque: {channel: motor/tau, deviation: -1.0}}", "{torque: [motor/tau]}", "motor/tau"}) {
    EXPECT_THROW(settingsOf(std::string("inputs: ") + wrong), InputError) << wrong;
  }
}

TEST(FollowSettings, GivesDeviationsOfAParameterInPartsOfItsValue) {
  const FollowSettings settings = settingsOf("parameters: {length: {deviation: 0.1, walk: 0.01}}");
  EXPECT_EQ(settings.of("pendulum").parameters[0].number.deviation, 0.1);
  EXPECT_EQ(settings.of("pendulum").parameters[0].number.walk, 0.01);
}

}  // namespace follow_settings_reader_test
}  // namespace whirl_twin
