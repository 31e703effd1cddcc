// A rosbag has the content of an LCM log of the same run; from a corrupt or aborted one all
// readable messages are read, and the others are counted. (Bags that rosbag itself has recorded:
// tests/ros/bag.test.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>
#include <type_traits>

#include "bag_sample.h"
#include "state_samples.h"
#include "transport/bag_scan.h"
#include "transport/logged_messages.h"
#include "transport/ros_layout.h"

namespace whirl_twin {
namespace logged_bag_test {

struct Read {
  LoggedMessages log;
  std::vector<Message> messages;
  std::vector<std::int64_t> stamps;  // us
};

Read read(const Bytes& bytes, const std::string& prefix = "MACHINE_",
          const Kinds& kinds = allKinds()) {
  const TemporaryLog file;
  file.write(bytes);
  Read read;
  read.log = readLoggedMessages(
      file.path(), prefix, kinds,
      [&](const Message& message, std::int64_t stamp) {
        read.messages.push_back(message);
        read.stamps.push_back(stamp);
      },
      [](std::uint64_t, std::uint64_t) {});
  return read;
}

state::Measurement block(std::int64_t step) {
  state::Measurement block;
  block.at = {step, 1.0e-3 * static_cast<double>(step), 1'000'000 * step};
  block.source = "probes";
  block.channel = {"x"};
  block.unit = {"m"};
  block.deviation = {3.0e-6};
  block.samples = 1;
  block.instant = {1'000'000 * step};
  block.first_instant = block.instant.front();
  block.value = {1.0e-4 * static_cast<double>(step)};
  block.valid = {1};
  return block;
}

BagSample blocks(int count) {
  BagSample bag;
  for (int k = 0; k < count; ++k) {
    bag.write("/machine/measured/probes", 1'000'000 * k, toRos(block(k)));
  }
  return bag;
}

TEST(LoggedBag, EveryKindComesOutToTheBit) {
  StateSamples samples(1);
  for (int i = 0; i < 100; ++i) {
    samples.each([](const auto& state) {
      using State = std::decay_t<decltype(state)>;
      if constexpr (!std::is_same_v<State, state::Alert>) {  // ROS has them in an AlertArray
        BagSample bag;
        bag.write("/plant/machine/" + topicOf(state), 1'234'567'890'123'456'789, toRos(state));
        const Read found = read(bag.bytes(), "PLANT_MACHINE_");
        ASSERT_EQ(found.messages.size(), 1u) << State::kKind.name;
        EXPECT_EQ(bitsOf(std::get<State>(found.messages.front())), bitsOf(state));
        EXPECT_EQ(found.stamps.front(), 1'234'567'890'123'456);
        EXPECT_EQ(found.log.damaged + found.log.rejected, 0u);
      }
    });
  }
}

TEST(LoggedBag, OnlyWhatIsAskedForIsTaken) {
  BagSample bag = blocks(3);
  bag.write("/twin/measured/probes", 5, toRos(block(3)));
  bag.write("/machine/rotor/whirl", 6, toRos(whirlAt(1)));
  bag.write("/machine/elsewhere/probes", 7, toRos(block(4)));  // no topic of a measurement
  const Read machine = read(bag.bytes(), "MACHINE_", {&state::Measurement::kKind});
  EXPECT_EQ(machine.log.taken, 3u);
  EXPECT_EQ(read(bag.bytes(), "TWIN_").log.taken, 1u);
  const LoggedMessages none = read(bag.bytes(), "OTHER_").log;
  EXPECT_EQ(none.taken, 0u);
  EXPECT_NE(foundElsewhere(none).find("MACHINE_, TWIN_"), std::string::npos)
      << foundElsewhere(none);
}

TEST(LoggedBag, AMessageAboutAnotherThanItsTopicIsRejected) {
  BagSample bag;
  bag.write("/machine/measured/torque", 0, toRos(block(0)));
  EXPECT_EQ(read(bag.bytes()).log.rejected, 1u);
}

TEST(LoggedBag, ACommandNeedNotSayToWhom) {
  BagSample bag;
  ControllerCommand command;
  command.sample = 7;
  command.values = {0.25};
  bag.write("/machine/controllers/pd/command", 0, command);
  InputCommand input;
  input.duration = 1.0;
  bag.write("/machine/rotor/inputs", 1, input);
  const Read found = read(bag.bytes());
  ASSERT_EQ(found.messages.size(), 2u);
  const auto& answer = std::get<state::ControllerCommand>(found.messages[0]);
  EXPECT_EQ(answer.controller, "pd");
  EXPECT_EQ(answer.at.step, 7);
  EXPECT_EQ(answer.values, std::vector<double>{0.25});
  EXPECT_EQ(std::get<state::InputCommand>(found.messages[1]).system, "rotor");
}

TEST(LoggedBag, JointStatesAreMeasurements) {
  sensor_msgs::JointState joints;
  joints.header.stamp = ros::Time(100, 5);
  joints.name = {"theta1", "theta2"};
  joints.position = {0.1, 0.2};
  joints.velocity = {1.0, std::numeric_limits<double>::quiet_NaN()};
  for (const char* topic : {"/machine/encoder", "/encoder"}) {
    BagSample bag;
    bag.write(topic, 0, joints);
    bag.write("/twin/arm/joint_states", 0, joints);  // the twin's own messages are not the plant's
    const Read found = read(bag.bytes());
    ASSERT_EQ(found.messages.size(), 1u) << topic;
    const auto& measured = std::get<state::Measurement>(found.messages.front());
    EXPECT_EQ(measured.source, "encoder");
    EXPECT_EQ(measured.channel,
              (std::vector<std::string>{"theta1", "theta2", "theta1_rate", "theta2_rate"}));
    EXPECT_EQ(measured.instant, (std::vector<std::int64_t>{100'000'000'005}));
    EXPECT_EQ(measured.value[1], 0.2);
    EXPECT_EQ(measured.valid, (std::vector<std::uint8_t>{1, 1, 1, 0}));
  }
}

/// A recorder that was killed has written no index, and no length of its last chunk.
TEST(LoggedBag, ARecordingThatWasBrokenOffIsReadAsFarAsItGoes) {
  const Bytes whole = blocks(100).bytes(false);
  EXPECT_EQ(read(whole).log.taken, 100u);
  const Read cut = read(Bytes(whole.begin(), whole.end() - 20));
  EXPECT_EQ(cut.log.taken, 99u);
  EXPECT_EQ(cut.log.damaged, 1u);
  EXPECT_NE(cut.log.first_damage.find("the file ends"), std::string::npos) << cut.log.first_damage;
}

TEST(LoggedBag, DamageIsSaidWithItsPlaceAndTheNextChunkIsRead) {
  Bytes bytes = blocks(10).bytes();
  const Bytes second = blocks(5).bytes();
  const auto chunk = [](const Bytes& bag) {
    const char* const begin = "compression=none";
    return std::search(bag.begin(), bag.end(), begin, begin + std::strlen(begin)) - 8;
  };
  const auto first_chunk = static_cast<std::size_t>(chunk(bytes) - bytes.begin());
  bytes.insert(bytes.end(), chunk(second), second.end());
  ASSERT_EQ(read(bytes).log.taken, 15u);
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(first_chunk), 4, 0xff);
  const Read found = read(bytes);
  EXPECT_EQ(found.log.taken, 5u);
  EXPECT_EQ(found.log.damaged, 1u);
  EXPECT_EQ(found.log.first_damage.find("byte " + std::to_string(first_chunk) + ":"), 0u)
      << found.log.first_damage;
}

TEST(LoggedBag, WhatIsNoBagOfTodayIsRefused) {
  for (const char* text : {"#ROSBAG V1.2\n", "#ROSBAG V"}) {
    EXPECT_THROW(read(Bytes(text, text + std::strlen(text))), InputError) << text;
  }
}

/// Definitions of before a field was added, and of others.
TEST(RosLayout, GoesByTheDefinitionThatTheBagHas) {
  const RosLayout layout(
      "# a comment\nHeader header\nint8 LIMIT=5\nstring NAME=a # b\nother/Pair[] pairs\n"
      "float32[2] xs\n====================\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\n"
      "string frame_id\n======\nMSG: other/Pair\nint16 low\nuint8 high\n");
  const std::string bytes(
      "\1\0\0\0"
      "\2\0\0\0"
      "\3\0\0\0"
      "\1\0\0\0a"
      "\2\0\0\0"
      "\xff\xff\7"
      "\1\0\xff"
      "\0\0\x80?"
      "\0\0\0\xc0",
      35);
  const RosValues values =
      layout.read(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  EXPECT_EQ(values.at("header.stamp").whole, (std::vector<std::int64_t>{2'000'000'003}));
  EXPECT_EQ(values.at("header.frame_id").text, (std::vector<std::string>{"a"}));
  EXPECT_EQ(values.at("pairs.low").whole, (std::vector<std::int64_t>{-1, 1}));
  EXPECT_EQ(values.at("pairs.high").whole, (std::vector<std::int64_t>{7, 255}));
  EXPECT_EQ(values.at("xs").real, (std::vector<double>{1.0, -2.0}));
  for (const char* wrong : {"int8", "int8 a b", "int8[0] a", "int8[x] a", "Nothing a",
                            "Self s\n====\nMSG: a/Self\nSelf s", "E[] e\n====\nMSG: a/E\n"}) {
    EXPECT_THROW(RosLayout{wrong}, RejectedMessage) << wrong;
  }
}

/// 3,000 corrupt bags; 100,000 with WHIRL_TWIN_EXTREMES=full.
TEST(LoggedBag, WhateverStandsInAFileIsReadToItsEnd) {
  const char* const length = std::getenv("WHIRL_TWIN_EXTREMES");
  const int bags = length != nullptr && std::strcmp(length, "full") == 0 ? 100'000 : 3'000;
  BagSample sample = blocks(20);
  sample.write("/machine/rotor/whirl", 6, toRos(whirlAt(1)));
  sample.write("/machine/encoder", 7, sensor_msgs::JointState());
  const Bytes sound[] = {sample.bytes(), sample.bytes(false)};
  std::mt19937 random(1);
  for (int k = 0; k < bags; ++k) {
    Bytes bytes = sound[k % 2];
    for (std::size_t times = 1 + random() % 4; times > 0; --times) {
      // Mostly after the padding of the header, where the data are.
      const std::size_t at =
          random() % 8 == 0 ? random() % bytes.size() : 4100 + random() % (bytes.size() - 4100);
      const std::uint32_t words[] = {0,          1,          0x7fffffff,
                                     0x80000000, 0xffffffff, static_cast<std::uint32_t>(random())};
      const std::uint32_t word = words[random() % 6];
      std::memcpy(bytes.data() + std::min(at, bytes.size() - 4), &word, 1 + random() % 4);
    }
    if (random() % 4 == 0) {
      bytes.resize(20 + random() % (bytes.size() - 20));
    }
    try {
      EXPECT_LE(read(bytes).log.taken, 22u);
    } catch (const InputError& why) {  // its first line
      EXPECT_NE(std::string(why.what()).find("must be a rosbag"), std::string::npos);
    }
  }
}

}  // namespace logged_bag_test
}  // namespace whirl_twin
