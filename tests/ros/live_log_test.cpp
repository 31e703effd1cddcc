// A log of the live simulation and one that `twin simulate` wrote of the same scene contain the
// same channels and, at equal steps, the same values: the output of a step has a single definition.

#include <gtest/gtest.h>
#include <unistd.h>
#include <whirl_twin/LoopStatistics.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <set>
#include <string>

#include "../transport/state_samples.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_decode.h"
#include "transport/lcm_recorder.h"
#include "waiting.h"

namespace whirl_twin {
namespace live_log_test {

constexpr const char* kScene = WHIRL_TWIN_SOURCE "/tests/ros/scenes/all_messages.yaml";
constexpr std::int64_t kLastStep = 11000;  // parameters are published again after 10 s

/// The messages of a log by channel and step, as bits, without the stamp; without those that only a
/// live twin and its monitor publish.
using Log = std::map<std::string, std::map<std::int64_t, std::string>>;

Log readLog(const std::string& path) {
  Log log;
  lcm::LogFile file(path, "r");
  while (const lcm::LogEvent* event = file.readNextEvent()) {
    Message message =
        decodeEvent(event->channel, event->data, static_cast<std::size_t>(event->datalen));
    std::visit(
        [&](auto& state) {
          using State = std::decay_t<decltype(state)>;
          if constexpr (!State::kKind.has(MessageKind::kJudged) &&
                        !std::is_same_v<State, state::LoopStatistics> &&
                        !std::is_same_v<State, state::SceneText>) {
            state.at.stamp = 0;
            log[event->channel][state.at.step] = bitsOf(state);
          }
        },
        message);
  }
  return log;
}

std::set<std::string> channelsOf(const Log& log) {
  std::set<std::string> channels;
  for (const auto& [channel, messages] : log) {
    channels.insert(channel);
  }
  return channels;
}

TEST(LiveLog, holdsWhatASimulatedLogHolds) {
  const std::string base = "/tmp/whirl_twin_live_log_" + std::to_string(::getpid());
  const std::string recorded = base + "_recorded.lcmlog";
  const std::string simulated = base + "_simulated.lcmlog";
  ros::NodeHandle node("/twin");
  LoopStatistics loop;
  const boost::function<void(const LoopStatistics::ConstPtr&)> on_loop =
      [&loop](const LoopStatistics::ConstPtr& m) { loop = *m; };
  const ros::Subscriber subscriber = node.subscribe<LoopStatistics>("loop", 10, on_loop);
  LcmRecorder recorder(openLcm(kDefaultLcmUrl), "TWIN_.*", recorded);
  ASSERT_TRUE(waitUntil([&] {
    recorder.record(std::chrono::milliseconds(5));
    return loop.step > kLastStep;
  }));
  // Otherwise the observer has not processed every step, and may differ.
  ASSERT_EQ(loop.dropped_snapshots, 0u);
  const std::string simulate = std::string(WHIRL_TWIN_PROGRAM) + " simulate " + kScene +
                               " --duration 12 --output " + simulated;
  ASSERT_EQ(std::system(simulate.c_str()), 0);
  const Log live = readLog(recorded);
  const Log alone = readLog(simulated);
  std::remove(recorded.c_str());
  std::remove(simulated.c_str());

  EXPECT_EQ(channelsOf(live), channelsOf(alone));
  EXPECT_EQ(
      channelsOf(alone),
      (std::set<std::string>{"TWIN_ARMS_PARAMETER", "TWIN_ARMS_PENDULUM", "TWIN_DRIVEN_ORDERS",
                             "TWIN_DRIVEN_PARAMETER", "TWIN_DRIVEN_WHIRL", "TWIN_ENGINE_DRIVE",
                             "TWIN_ENGINE_MOTOR", "TWIN_MANY_ENSEMBLE", "TWIN_MANY_ORDERS",
                             "TWIN_MANY_PARAMETER", "TWIN_MANY_WHIRL", "TWIN_ROTOR_ORDERS",
                             "TWIN_ROTOR_PARAMETER", "TWIN_ROTOR_WHIRL", "TWIN_SHAFT_DRIVE"}));
  for (const auto& [channel, messages] : live) {
    std::size_t compared = 0;
    for (const auto& [step, bits] : messages) {
      const auto& same = alone.at(channel);
      if (const auto found = same.find(step); found != same.end()) {
        ++compared;
        ASSERT_EQ(found->second, bits) << channel << ", step " << step;
      }
    }
    EXPECT_GE(compared, channel.find("PARAMETER") != std::string::npos  ? 1u
                        : channel.find("ENSEMBLE") != std::string::npos ? 100u
                        : channel.find("ORDERS") != std::string::npos   ? 100u
                                                                        : 2000u)
        << channel;
  }
}

}  // namespace live_log_test
}  // namespace whirl_twin
