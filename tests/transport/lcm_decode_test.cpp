#include "transport/lcm_decode.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "state_samples.h"
#include "transport/earlier_forms.h"
#include "transport/lcm_converters.h"

namespace whirl_twin {
namespace lcm_decode_test {

using Payload = std::vector<std::uint8_t>;

template <class State>
Payload encoded(const State& state) {
  Payload payload;
  encode(state, payload);
  return payload;
}

Message decoded(const std::string& channel, const Payload& payload) {
  return decodeEvent(channel, payload.data(), payload.size());
}

template <class State>
void expectSameAfterTheWire(const State& state) {
  const auto back = decoded(channelOf(state), encoded(state));
  ASSERT_TRUE(std::holds_alternative<State>(back));
  EXPECT_EQ(bitsOf(std::get<State>(back)), bitsOf(state));
}

TEST(LcmDecode, BringsEveryBitBackFromTheWire) {
  StateSamples samples(1);
  for (int i = 0; i < 300; ++i) {
    samples.each([](const auto& state) { expectSameAfterTheWire(state); });
  }
}

/// A margin and a pendulum whose payloads contain arrays and strings.
state::PendulumState doublePendulum() {
  state::PendulumState pendulum;
  pendulum.system = "arm";
  pendulum.name = {"theta1", "theta2"};
  pendulum.angle = {0.1, 0.2};
  pendulum.rate = {1.0, 2.0};
  return pendulum;
}

template <class State>
void expectEveryCutRejected(const State& state) {
  const auto whole = encoded(state);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THROW(decoded(channelOf(state), Payload(whole.begin(), whole.begin() + length)),
                 RejectedMessage)
        << length << " of " << whole.size() << " bytes";
  }
  auto longer = whole;
  longer.push_back(0);
  EXPECT_THROW(decoded(channelOf(state), longer), RejectedMessage);
}

// A margin in a format without its later fields: present fields are kept, absent ones are marked
// unknown.
TEST(LcmDecode, PlaysMarginsInTheirEarlierForms) {
  StateSamples samples(5);
  for (const EarlierForm& form : kEarlierForms<state::StabilityMargin>) {
    for (int i = 0; i < 20; ++i) {
      state::StabilityMargin margin = samples.margin();
      const state::StabilityMargin unset;
      margin.unreduced_decay_rate = margin.unreduced_log_decrement = unset.unreduced_decay_rate;
      margin.reduction_disagrees = false;
      if (form.later.size() > 3) {
        margin.log_decrement_coordinate = "";
        margin.log_decrement_amplitude = unset.log_decrement_amplitude;
      }
      if (form.later.size() > 5) {
        margin.members = margin.members_beyond = 0;
        margin.lowest_decay_rate = unset.lowest_decay_rate;
        margin.stable_throughout = false;
      }
      if (form.later.size() > 9) {
        margin.nearest_parameter = margin.nearest_loss = "";
        margin.nearest_change = margin.nearest_value = margin.nearest_frequency =
            unset.nearest_change;
        margin.nearest_time = margin.cross_coupling_margin = unset.nearest_change;
        margin.right_by_eigenvalues = 0;
        margin.routh_disagrees = false;
      }
      if (form.later.size() > 18) {
        margin.threshold_below = margin.threshold_above = margin.age = unset.age;
      }
      Payload then = encoded(margin);
      then.resize(then.size() - sizeUnset(form.later));
      for (std::size_t byte = 0; byte < 8; ++byte) {
        then[byte] = static_cast<std::uint8_t>(form.fingerprint >> (8 * (7 - byte)));
      }
      const Message back = decoded(channelOf(margin), then);
      ASSERT_TRUE(std::holds_alternative<state::StabilityMargin>(back));
      EXPECT_EQ(bitsOf(std::get<state::StabilityMargin>(back)), bitsOf(margin));
    }
  }
}

TEST(LcmDecode, RejectsAPayloadCutAnywhereOrTooLong) {
  StateSamples samples(2);
  samples.each([](const auto& state) { expectEveryCutRejected(state); });
  expectEveryCutRejected(doublePendulum());
}

TEST(LcmDecode, RejectsLengthsThatWouldReadOrAllocateBeyondThePayload) {
  const auto pendulum = doublePendulum();
  const auto good = encoded(pendulum);
  constexpr std::size_t kSystemLength = 8 + 3 * 8;                 // fingerprint, 3 int64
  constexpr std::size_t kCoordinates = kSystemLength + 4 + 4 + 8;  // "arm" and its 0, time
  ASSERT_EQ(good[kSystemLength + 3], 4);
  ASSERT_EQ(good[kCoordinates + 3], 2);
  for (const std::size_t at : {kSystemLength, kCoordinates}) {
    for (const std::int32_t length :
         {std::numeric_limits<std::int32_t>::min(), -1, std::numeric_limits<std::int32_t>::max(),
          1 << 28, static_cast<std::int32_t>(good.size()), 0}) {
      auto payload = good;
      for (int byte = 0; byte < 4; ++byte) {
        payload[at + byte] =
            static_cast<std::uint8_t>(static_cast<std::uint32_t>(length) >> (24 - 8 * byte));
      }
      EXPECT_THROW(decoded("TWIN_ARM_PENDULUM", payload), RejectedMessage) << length;
    }
  }
}

TEST(LcmDecode, RejectsAnotherTypeAndAnotherSystemsChannel) {
  const auto pendulum = encoded(doublePendulum());
  EXPECT_NO_THROW(decoded("TWIN_ARM_PENDULUM", pendulum));
  EXPECT_THROW(decoded("TWIN_ARM_WHIRL", pendulum), RejectedMessage);
  EXPECT_THROW(decoded("TWIN_LEG_PENDULUM", pendulum), RejectedMessage);
  EXPECT_THROW(decoded("ROBOT", pendulum), RejectedMessage);
  EXPECT_THROW(decodeEvent("TWIN_ARM_PENDULUM", nullptr, 0), RejectedMessage);
  auto other_type = pendulum;
  other_type[0] ^= 1;
  EXPECT_THROW(decoded("TWIN_ARM_PENDULUM", other_type), RejectedMessage);
}

/// Corrupts the payload of a state in a few places after the fingerprint.
template <class State>
void expectDamageSurvived(const State& sent, std::mt19937& random) {
  auto payload = encoded(sent);
  for (auto hits = random() % 4 + 1; hits > 0; --hits) {
    payload[8 + random() % (payload.size() - 8)] = static_cast<std::uint8_t>(random());
  }
  try {
    const auto state = decoded(channelOf(sent), payload);
    EXPECT_EQ(channelOf(std::get<State>(state)), channelOf(sent));
  } catch (const RejectedMessage&) {
    return;  // the other right answer
  }
}

TEST(LcmDecode, SurvivesAnyDamage) {
  StateSamples samples(3);
  std::mt19937 random(4);
  for (int i = 0; i < 20000; ++i) {
    expectDamageSurvived(samples.margin(), random);
    expectDamageSurvived(samples.ensemble(), random);
  }
}

}  // namespace lcm_decode_test
}  // namespace whirl_twin
