#include "transport/channels.h"

#include <gtest/gtest.h>

#include "messages/message_check.h"

namespace whirl_twin {
namespace {

TEST(Channels, AreNamedAsTheInterfaceSays) {
  EXPECT_EQ(channelName(ChannelKind::kWhirl, "rotor"), "TWIN_ROTOR_WHIRL");
  EXPECT_EQ(channelName(ChannelKind::kPendulum, "arm_2"), "TWIN_ARM_2_PENDULUM");
  EXPECT_EQ(channelName(ChannelKind::kStability, "rotor"), "TWIN_ROTOR_STABILITY");
  EXPECT_EQ(channelName(ChannelKind::kParameter, "rotor"), "TWIN_ROTOR_PARAMETER");
  EXPECT_EQ(channelName(ChannelKind::kEnsemble, "rotor"), "TWIN_ROTOR_ENSEMBLE");
  EXPECT_EQ(channelName(ChannelKind::kDrive, "shaft"), "TWIN_SHAFT_DRIVE");
  EXPECT_EQ(channelName(ChannelKind::kMotor, "shaft"), "TWIN_SHAFT_MOTOR");
  EXPECT_EQ(channelName(ChannelKind::kAlerts), "TWIN_ALERTS");
}

TEST(Channels, AreParsedBackToKindAndName) {
  // Names may themselves end like a kind of channel: the last ending counts.
  for (const std::string name :
       {"ROTOR", "A", "MY_WHIRL", "AN_ENSEMBLE", "X_DRIVE", "TWIN_ALERTS", "PENDULUM"}) {
    for (const auto kind : {ChannelKind::kWhirl, ChannelKind::kPendulum, ChannelKind::kStability,
                            ChannelKind::kParameter, ChannelKind::kEnsemble, ChannelKind::kDrive,
                            ChannelKind::kMotor}) {
      const auto channel = parseChannel(channelName(kind, name));
      ASSERT_TRUE(channel) << channelName(kind, name);
      EXPECT_EQ(channel->kind, kind);
      EXPECT_EQ(channel->name, name);
    }
  }
  ASSERT_TRUE(parseChannel("TWIN_ALERTS"));
  EXPECT_EQ(parseChannel("TWIN_ALERTS")->kind, ChannelKind::kAlerts);
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
  EXPECT_EQ(channelName(ChannelKind::kStability, longest).size(), 63u);  // LCM's limit
  EXPECT_EQ(channelName(ChannelKind::kParameter, longest).size(), 63u);
  EXPECT_LE(channelName(ChannelKind::kEnsemble, longest).size(), 63u);
}

}  // namespace
}  // namespace whirl_twin
