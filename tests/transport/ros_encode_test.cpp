// Files written for ROS's tools without ROS are byte-identical to those that ROS itself writes.
#include "transport/ros_encode.h"

#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <string>
#include <type_traits>
#include <vector>

#include "state_samples.h"
#include "transport/channels.h"
#include "transport/ros_converters.h"

namespace whirl_twin {
namespace ros_encode_test {

template <class RosMessage>
std::string serialized(const RosMessage& message) {
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

std::string encoded(RosEncoder& encoder, const Message& message) {
  const LittleEndian& bytes = encoder.encode(message);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <class RosMessage>
void expectTopicOf(const RecordedTopic& topic) {
  EXPECT_EQ(topic.type, ros::message_traits::DataType<RosMessage>::value());
  EXPECT_EQ(topic.md5sum, ros::message_traits::MD5Sum<RosMessage>::value()) << topic.type;
  EXPECT_EQ(topic.definition, ros::message_traits::Definition<RosMessage>::value());
}

TEST(RosEncode, EveryKindHasTheBytesAndTheDefinitionThatRosHas) {
  StateSamples samples(3);
  RosEncoder encoder("/twin");
  for (int i = 0; i < 100; ++i) {
    samples.each([&](const auto& state) {
      using State = std::decay_t<decltype(state)>;
      if constexpr (!std::is_same_v<State, state::Alert>) {
        EXPECT_EQ(encoded(encoder, state), serialized(toRos(state))) << State::kKind.type;
        expectTopicOf<RosType<State>>(encoder.topic());
        EXPECT_EQ(encoder.topic().topic, "/twin/" + topicOf(state));
        EXPECT_EQ(encoder.topic().latching, State::kKind.has(MessageKind::kLatched));
      }
    });
  }
}

TEST(RosEncode, AlertsBecomeTheListOfThoseThatStand) {
  StateSamples samples(4);
  state::Alert mild = samples.alert(), grave = samples.alert();
  mild.id = 1;
  mild.severity = state::Severity::kWarning;
  mild.raised = grave.raised = true;
  grave.id = 2;
  grave.severity = state::Severity::kDanger;
  mild.time = grave.time = 1.0;
  RosEncoder encoder("/twin");
  EXPECT_EQ(encoded(encoder, mild), serialized(toRos(std::vector{mild}, mild.stamp)));
  EXPECT_EQ(encoded(encoder, grave), serialized(toRos(std::vector{grave, mild}, grave.stamp)));
  expectTopicOf<AlertArray>(encoder.topic());
  EXPECT_EQ(encoder.topic().topic, "/twin/alerts");
  mild.raised = false;
  EXPECT_EQ(encoded(encoder, mild), serialized(toRos(std::vector{grave}, mild.stamp)));
  mild.raised = true;
  mild.time = 0.5;  // the twin restarts: previous alerts are void
  EXPECT_EQ(encoded(encoder, mild), serialized(toRos(std::vector{mild}, mild.stamp)));
}

}  // namespace ros_encode_test
}  // namespace whirl_twin
