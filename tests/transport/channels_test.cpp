#include "transport/channels.h"

#include <gtest/gtest.h>

#include "messages/message_check.h"

namespace whirl_twin {
namespace channels_test {

TEST(Channels, AreNamedAsTheInterfaceSays) {
  EXPECT_EQ(channelName(state::WhirlState::kKind, "rotor"), "TWIN_ROTOR_WHIRL");
  EXPECT_EQ(channelName(state::PendulumState::kKind, "arm_2"), "TWIN_ARM_2_PENDULUM");
  EXPECT_EQ(channelName(state::StabilityMargin::kKind, "rotor"), "TWIN_ROTOR_STABILITY");
  EXPECT_EQ(channelName(state::ParameterChange::kKind, "rotor"), "TWIN_ROTOR_PARAMETER");
  EXPECT_EQ(channelName(state::EnsembleState::kKind, "rotor"), "TWIN_ROTOR_ENSEMBLE");
  EXPECT_EQ(channelName(state::DriveState::kKind, "shaft"), "TWIN_SHAFT_DRIVE");
  EXPECT_EQ(channelName(state::MotorState::kKind, "shaft"), "TWIN_SHAFT_MOTOR");
  EXPECT_EQ(channelName(state::FollowState::kKind, "rotor"), "TWIN_ROTOR_FOLLOW");
  EXPECT_EQ(channelName(state::Alert::kKind), "TWIN_ALERTS");
  EXPECT_EQ(channelName(state::LoopStatistics::kKind), "TWIN_LOOP");
}

TEST(Channels, AreParsedBackToKindAndName) {
  // Names may themselves end like a kind of channel: the last ending counts.
  for (const std::string name :
       {"ROTOR", "A", "MY_WHIRL", "AN_ENSEMBLE", "X_DRIVE", "TWIN_ALERTS", "PENDULUM"}) {
    for (const MessageKind* kind : allKinds()) {
      for (const std::string prefix : {"TWIN_", "PLANT_MACHINE_", "X"}) {
        const auto channel = parseChannel(channelName(*kind, name, prefix), prefix);
        ASSERT_TRUE(channel) << channelName(*kind, name, prefix);
        EXPECT_EQ(channel->kind, kind);
        EXPECT_TRUE(channel->name == name || channel->name.empty());
      }
    }
  }
  ASSERT_TRUE(parseChannel("TWIN_ALERTS"));
  EXPECT_EQ(parseChannel("TWIN_ALERTS")->kind, &state::Alert::kKind);
  EXPECT_EQ(parseChannel("TWIN_ROTOR_WHIRL")->name, "ROTOR");
}

TEST(Channels, AndTopicsGoTogether) {
  state::MotorState motor;
  motor.drive = "shaft";
  motor.system = "rotor";
  EXPECT_EQ(channelOf(motor), "TWIN_SHAFT_MOTOR");
  EXPECT_EQ(topicOf(motor), "drives/shaft/motor");
  state::WhirlState whirl;
  whirl.system = "rotor";
  EXPECT_EQ(topicOf(whirl), "rotor/whirl");
  EXPECT_EQ(topicOf(state::LoopStatistics()), "loop");
  EXPECT_EQ(channelOf(state::LoopStatistics()), "TWIN_LOOP");
  EXPECT_EQ(topicOf(state::Alert()), "alerts");
}

TEST(Channels, OfATwinInANamespaceBeginWithIt) {
  EXPECT_EQ(lcmPrefixOf("/twin"), kDefaultLcmPrefix);
  EXPECT_EQ(lcmPrefixOf("/machine"), "MACHINE_");
  EXPECT_EQ(lcmPrefixOf("/plant/machine_2"), "PLANT_MACHINE_2_");
  EXPECT_FALSE(parseChannel("TWIN_ROTOR_WHIRL", "MACHINE_"));
  EXPECT_FALSE(parseChannel("MACHINE_ROTOR_WHIRL"));
  EXPECT_NO_THROW(requireLcmPrefix("MACHINE_"));
  for (const std::string prefix : {"", "_", "2_", "A B_", "A.*", "TWIN-"}) {
    EXPECT_THROW(requireLcmPrefix(prefix), InputError) << prefix;
  }
}

TEST(Channels, OfOthersAreNotTheTwins) {
  for (const std::string channel : {"", "TWIN_", "TWIN__WHIRL", "TWIN_WHIRL", "TWIN_rotor_WHIRL",
                                    "TWIN_ROTOR_WHIRLS", "XTWIN_ROTOR_WHIRL", "TWIN_RO TOR_WHIRL",
                                    "TWIN_2_WHIRL", "TWIN_ROTOR", "ROBOT_STATE", "TWIN_ALERTS_"}) {
    EXPECT_FALSE(parseChannel(channel)) << channel;
  }
}

TEST(Channels, OfTheLongestNameFitLcm) {
  const std::string longest(kMaxNameLength, 'a');
  EXPECT_TRUE(isLegalName(longest));
  EXPECT_FALSE(isLegalName(longest + "a"));
  EXPECT_EQ(channelName(state::StabilityMargin::kKind, longest).size(), 63u);  // LCM's limit
  EXPECT_EQ(channelName(state::ParameterChange::kKind, longest).size(), 63u);
  EXPECT_LE(channelName(state::EnsembleState::kKind, longest).size(), 63u);
  EXPECT_NO_THROW(requireChannelFits(channelName(state::StabilityMargin::kKind, longest)));
  EXPECT_THROW(requireChannelFits(channelName(state::StabilityMargin::kKind, longest, "MACHINE_")),
               InputError);
}

}  // namespace channels_test
}  // namespace whirl_twin
