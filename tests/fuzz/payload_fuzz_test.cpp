// Any bytes received or in a log: each payload is a message or is rejected with an error text, a
// log is read to its end, and a monitor that receives all of it continues. 60,000 payloads, 3,000
// of them to a monitor, and 1,000 logs; a million, 100,000 and 60,000 with
// WHIRL_TWIN_EXTREMES=full.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "../transport/event_log_sample.h"
#include "../transport/state_samples.h"
#include "breaker.h"
#include "messages/message_check.h"
#include "monitoring/twin_monitor.h"
#include "scene/scene_reader.h"
#include "transport/lcm_converters.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {
namespace payload_fuzz_test {

/// The round trip is exact: the decoded message encodes and decodes to the same bits again.
void expectBelievable(const Message& message) {
  std::visit(
      [](const auto& state) {
        Bytes again;
        encode(state, again);
        const Message back = decodeEvent(channelOf(state), again.data(), again.size());
        ASSERT_EQ(back.index(), Message(state).index());
        EXPECT_EQ(bitsOf(std::get<std::decay_t<decltype(state)>>(back)), bitsOf(state));
      },
      message);
}

TEST(PayloadFuzz, DamagedPayloadsAreMessagesOrRejectedInWords) {
  const int wanted = often(60000, 1000000);
  StateSamples samples(7);
  Breaker breaker(7);
  int payloads = 0, taken = 0;
  while (payloads < wanted && !::testing::Test::HasFailure()) {
    samples.each([&](const auto& state) {
      Bytes payload;
      encode(state, payload);
      breaker.damage(payload);
      ++payloads;
      try {
        expectBelievable(decodeEvent(channelOf(state), payload.data(), payload.size()));
        ++taken;
      } catch (const RejectedMessage& why) {
        const std::string said = why.what();
        EXPECT_FALSE(said.empty());
        EXPECT_LT(said.size(), 2000u);
      }
    });
  }
  // Corruption that is always or never detected would test only half of the code.
  EXPECT_GT(taken, payloads / 20);
  EXPECT_LT(taken, payloads * 19 / 20);
}

constexpr const char* kScene = R"(
step: 0.001
drives: {shaft: {speed: 60.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 10.0, stiffness: 5.0e+4, eccentricity: 1.0e-4, damping: 20.0}
)";

/// Messages of a rotor that runs, one step after another.
Bytes payloadOfStep(std::int64_t step, std::size_t kind, std::string& channel) {
  const state::Instant at{step, static_cast<double>(step) * 1e-3, step * 1000000};
  Bytes payload;
  const auto sent = [&](const auto& state) {
    encode(state, payload);
    channel = channelOf(state);
  };
  if (kind == 0) {
    state::DriveState drive;
    drive.at = at;
    drive.drive = "shaft";
    drive.speed = 60.0;
    drive.shaft_angle = 60.0 * at.time;
    sent(drive);
  } else if (kind == 1) {
    state::WhirlState whirl;
    whirl.at = at;
    whirl.system = "rotor";
    whirl.speed = 60.0;
    whirl.shaft_angle = 60.0 * at.time;
    whirl.x = 1e-4 * std::cos(whirl.shaft_angle);
    whirl.y = 1e-4 * std::sin(whirl.shaft_angle);
    whirl.x_rate = -60.0 * whirl.y;
    whirl.y_rate = 60.0 * whirl.x;
    sent(whirl);
  } else {
    state::LoopStatistics loop;
    loop.at = at;
    loop.system = {"rotor"};
    loop.integrator = {"exponential"};
    loop.error_estimate = {1e-9};
    loop.tolerance = {1e-6};
    loop.stopped = {0};
    loop.stopped_why = {""};
    sent(loop);
  }
  return payload;
}

TEST(PayloadFuzz, AMonitorThatIsToldAnythingGoesOn) {
  const int wanted = often(3000, 100000);
  const BuiltScene scene = build(readScene(YAML::Load(kScene), "fuzz"));
  AlarmSettings settings;
  settings.decay_audit = 10.0;
  TwinMonitor monitor(scene, settings);
  Breaker breaker(11);
  int taken = 0;
  double wall = 0.0;
  for (int i = 0; i < wanted; ++i) {
    std::string channel;
    Bytes payload = payloadOfStep(i, breaker.below(8) == 0 ? 2 : breaker.below(2), channel);
    if (breaker.below(3) == 0) {
      breaker.damage(payload);
    }
    wall += 1e-3;
    try {
      std::visit(
          [&](const auto& state) {
            using State = std::decay_t<decltype(state)>;
            if constexpr (std::is_same_v<State, state::WhirlState> ||
                          std::is_same_v<State, state::DriveState> ||
                          std::is_same_v<State, state::LoopStatistics>) {
              monitor.take(state, wall);
              ++taken;
            }
          },
          decodeEvent(channel, payload.data(), payload.size()));
    } catch (const RejectedMessage&) {
    }
    monitor.tick(wall, false);
    for (const state::StabilityMargin& margin : monitor.takeMargins()) {
      EXPECT_EQ(margin.system, "rotor");
    }
    for (const state::Alert& alert : monitor.alerts().takeEvents()) {
      EXPECT_FALSE(alert.text.empty());
    }
  }
  EXPECT_GT(taken, wanted / 2);
}

TEST(PayloadFuzz, DamagedLogsAreReadToTheirEnd) {
  const int wanted = often(1000, 60000);
  const Bytes sound = sampleLog(4);
  const TemporaryLog log;
  Breaker breaker(13);
  for (int i = 0; i < wanted; ++i) {
    Bytes bytes = sound;
    breaker.damage(bytes);
    log.write(bytes);
    const LogSummary summary = readEventLog(log.path());
    EXPECT_EQ(summary.size, bytes.size());
    EXPECT_LE(summary.unreadable_bytes, summary.size);
    EXPECT_LE(summary.defects.size(), kMaxNamedDefects);
  }
}

}  // namespace payload_fuzz_test
}  // namespace whirl_twin
