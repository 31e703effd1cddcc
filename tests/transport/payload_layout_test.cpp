// Arbitrary bytes decoded as any of the LCM types of the twin: a message that encodes to the same
// bytes again, or an error text; never a read or an allocation beyond the payload.
#include "transport/payload_layout.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <vector>

#include "state_samples.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_converters.h"
#include "transport/refused_payloads.h"
#include "whirl_twin/command_answer_t.hpp"
#include "whirl_twin/twin_command_t.hpp"

namespace whirl_twin {
namespace payload_layout_test {

using Payload = std::vector<std::uint8_t>;

template <class Type>
Payload payloadOf(const Type& message) {
  Payload payload(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(payload.data(), 0, static_cast<int>(payload.size()));
  return payload;
}

/// A whole payload, and what becomes of any: its bytes after decoding and encoding. It throws
/// RejectedMessage.
struct Door {
  std::string name;
  Payload whole;
  std::function<Payload(const Payload&)> pass;
};

template <class Type>
Door doorOf(const Type& message, const std::string& layout) {
  return {Type::getTypeName(), payloadOf(message), [layout](const Payload& payload) {
            return payloadOf(decodePayload<Type>(layout, payload.data(), payload.size()));
          }};
}

std::vector<Door> everyDoor() {
  std::vector<Door> doors;
  StateSamples(5).each([&](const auto& state) {
    using State = std::decay_t<decltype(state)>;
    doors.push_back(doorOf(toLcm(state), layoutOf<State>()));
  });
  twin_command_t command{};
  command.sender = "desk";
  command.command = "set_speed";
  command.name = "shaft";
  command.keys = {"speed", "max_jerk"};
  command.values = {50.0, 300.0};
  command.count = 2;
  doors.push_back(doorOf(command, kCommandLayout));
  command_answer_t answer{};
  answer.sender = "desk";
  answer.message = "done";
  answer.keys = {"duration"};
  answer.values = {2.0};
  answer.count = 1;
  doors.push_back(doorOf(answer, kAnswerLayout));
  return doors;
}

/// False if it is rejected.
bool taken(const Door& door, const Payload& payload) {
  try {
    // Exactly its own memory, so that a sanitizer sees a byte beyond.
    const Payload own(payload);
    EXPECT_EQ(door.pass(own), payload) << door.name;
    return true;
  } catch (const RejectedMessage& why) {
    EXPECT_GT(std::string(why.what()).size(), 10u);
    return false;
  }
}

TEST(PayloadLayout, EveryTypePassesWhole) {
  EXPECT_EQ(everyDoor().size(), std::variant_size_v<Message> + 2);
  for (const Door& door : everyDoor()) {
    EXPECT_TRUE(taken(door, door.whole)) << door.name;
  }
}

TEST(PayloadLayout, ACutOrLongerPayloadOfEveryTypeIsRefused) {
  for (const Door& door : everyDoor()) {
    for (std::size_t size = 0; size < door.whole.size(); ++size) {
      EXPECT_FALSE(taken(door, Payload(door.whole.begin(), door.whole.begin() + size)));
    }
    Payload longer = door.whole;
    longer.resize(longer.size() + 4, 0);
    EXPECT_FALSE(taken(door, longer));
    Payload endless = door.whole;
    endless.resize(kMaxLcmPayload + 1, 0);
    EXPECT_FALSE(taken(door, endless));
  }
}

TEST(PayloadLayout, AnotherFingerprintIsRefused) {
  for (const Door& door : everyDoor()) {
    for (std::size_t byte = 0; byte < 8; ++byte) {
      Payload other = door.whole;
      other[byte] ^= 0x10u;
      EXPECT_FALSE(taken(door, other)) << door.name;
    }
  }
}

// Lengths are somewhere among the words: each one is replaced by each length accepted by a decoder.
TEST(PayloadLayout, NoLengthOfAnyTypeIsBelieved) {
  for (const Door& door : everyDoor()) {
    for (std::size_t at = 8; at + 4 <= door.whole.size(); ++at) {
      for (const std::uint32_t length :
           {0u, 1u, 0xffffffffu, 0x80000000u, 0x7fffffffu, 0x10000000u, 0x00010000u}) {
        Payload damaged = door.whole;
        for (std::size_t byte = 0; byte < 4; ++byte) {
          damaged[at + byte] = static_cast<std::uint8_t>(length >> (24u - 8u * byte));
        }
        taken(door, damaged);
      }
    }
  }
}

TEST(PayloadLayout, AnyDamageOfAnyTypeIsSurvived) {
  std::mt19937 random(9);
  for (const Door& door : everyDoor()) {
    for (int i = 0; i < 2000; ++i) {
      Payload damaged = door.whole;
      for (auto hits = 1 + random() % 5; hits > 0; --hits) {
        damaged[8 + random() % (damaged.size() - 8)] = static_cast<std::uint8_t>(random());
      }
      taken(door, damaged);
    }
  }
}

TEST(RefusedPayloads, AreCountedByChannelWithinBounds) {
  RefusedPayloads refused;
  for (int i = 0; i < 1000; ++i) {
    refused.add("TWIN_" + std::to_string(i), "too short");
    refused.add("TWIN_0", "too long");
  }
  EXPECT_EQ(refused.total(), 2000u);
  EXPECT_EQ(refused.channels().at("TWIN_0"), 1001u);
  EXPECT_EQ(refused.channels().at(RefusedPayloads::kFurther),
            1000u - RefusedPayloads::kMaxChannels);
  EXPECT_EQ(refused.channels().size(), RefusedPayloads::kMaxChannels + 1);
  EXPECT_EQ(refused.last(), "TWIN_0: too long");
}

}  // namespace payload_layout_test
}  // namespace whirl_twin
