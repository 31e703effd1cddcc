// The wire format is stable: reference/wire.txt holds samples of every kind in their original
// encoding, and logs with it still exist. Later fields are appended; with them the fingerprint of
// the original belongs to an earlier form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <string>

#include "transport/earlier_forms.h"
#include "transport/lcm_converters.h"
#include "transport/lcm_decode.h"

#ifdef WHIRL_TWIN_WITH_ROS
#include <ros/serialization.h>

#include "transport/ros_converters.h"
#endif

namespace whirl_twin {
namespace wire_test {

using Bytes = std::vector<std::uint8_t>;

struct Sample {
  std::string channel;
  Bytes lcm, ros;
};

Bytes bytesOf(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

std::vector<Sample> samples() {
  std::ifstream file(WHIRL_TWIN_REFERENCE "/wire.txt");
  std::vector<Sample> samples;
  std::string channel, wire, hex;
  while (file >> channel >> wire >> hex) {
    if (wire == "lcm") {
      samples.push_back({channel, bytesOf(hex), {}});
    } else {
      samples.back().ros = bytesOf(hex);
    }
  }
  return samples;
}

Message decoded(const Sample& sample) {
  return decodeEvent(sample.channel, sample.lcm.data(), sample.lcm.size());
}

constexpr std::size_t kFingerprint = 8;  // bytes

/// From byte `from` on all that was there is there still, in its place.
void expectBeginsWith(const Bytes& now, const Bytes& then, std::size_t from,
                      const std::string& channel) {
  ASSERT_GE(now.size(), then.size()) << channel;
  EXPECT_TRUE(std::equal(then.begin() + from, then.end(), now.begin() + from)) << channel;
}

/// [bytes] of the fields that a kind has got since.
template <class State>
std::size_t laterFieldsOf(const State&) {
  if constexpr (kEarlierForms<State>.empty()) {
    return 0;
  } else {
    return sizeUnset(kEarlierForms<State>.front().later);
  }
}

TEST(Wire, OfLcmIsWhatItWas) {
  std::set<std::size_t> kinds;
  std::size_t critical_speeds = 0;
  for (const Sample& sample : samples()) {
    const Message message = decoded(sample);
    kinds.insert(message.index());
    const Bytes again = std::visit(
        [](const auto& state) {
          Bytes payload;
          encode(state, payload);
          return payload;
        },
        message);
    expectBeginsWith(again, sample.lcm, kFingerprint, sample.channel);
    std::visit(
        [&](const auto& state) {
          const auto later = laterFieldsOf(state);
          EXPECT_EQ(again.size(), sample.lcm.size() + later) << sample.channel;
          if (later == 0) {
            EXPECT_EQ(again, sample.lcm) << sample.channel;
          }
        },
        message);
    if (const auto* margin = std::get_if<state::StabilityMargin>(&message)) {
      critical_speeds += margin->critical_speeds.size();
      EXPECT_TRUE(std::isnan(margin->age)) << "nobody has set it";
      EXPECT_EQ(margin->nearest_parameter, "");
      EXPECT_TRUE(std::isnan(margin->nearest_change));
      EXPECT_FALSE(margin->routh_disagrees);
    }
  }
  EXPECT_EQ(kinds.size(), 8u);
  EXPECT_GT(critical_speeds, 0u);
}

#ifdef WHIRL_TWIN_WITH_ROS
template <class Type>
Bytes serialized(const Type& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

Bytes onRos(const state::Alert& alert) {
  return serialized(toRos(std::vector<state::Alert>{alert}, alert.stamp));
}

template <class State>
Bytes onRos(const State& state) {
  return serialized(toRos(state));
}

TEST(Wire, OfRosIsWhatItWas) {
  for (const Sample& sample : samples()) {
    const Bytes bytes = std::visit([](const auto& state) { return onRos(state); }, decoded(sample));
    expectBeginsWith(bytes, sample.ros, 0, sample.channel);
  }
}
#endif

}  // namespace wire_test
}  // namespace whirl_twin
