// lcm_bridge_node: republishes LCM channels TWIN_* on the ROS topics of a live twin, for played
// logs and remote twins. Needs no scene: that of a remote twin arrives with its states. Recorded
// stability margins and alerts only with ~derived: otherwise a monitor evaluates the states.
// Reports the messages received, lost and rejected, and duplicate publishers, on /diagnostics once
// a second, and at its end. The service ~ready (std_srvs/Trigger) exists as soon as the bridge has
// subscribed.
#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "monitoring/run_filter.h"
#include "nodes/changed_parameters.h"
#include "nodes/duplicate_publishers.h"
#include "nodes/lcm_bridge.h"
#include "nodes/node_parameters.h"
#include "nodes/refusal_report.h"
#include "nodes/rising_count.h"
#include "nodes/run_node.h"
#include "scene/yaml_file.h"
#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_receiver.h"
#include "transport/ros_parameters.h"
#include "transport/twin_namespace.h"

namespace whirl_twin {
namespace {

struct LcmBridgeParameters {
  std::string lcm_url, lcm_prefix;
  bool derived = false;
  double newest = 0.0;  ///< [Hz]
};

NodeParameters table(LcmBridgeParameters& p) {
  NodeParameters all(
      "lcm_bridge_node",
      "Publishes the LCM channels of a twin on the ROS topics of a live one: for played logs and\n"
      "twins on other machines. Needs no scene.");
  all.lcm(p.lcm_url, p.lcm_prefix, true)
      .flag("derived", p.derived, "also publish recorded margins and alerts")
      .number("newest", p.newest, {0.0, 1.0e5, "Hz", "every message"},
              "publish only the newest state, at this rate");
  return all;
}

constexpr std::chrono::milliseconds kPoll{50};
const ros::WallDuration kReportPeriod(1.0);

Kinds kindsToTell(bool derived) {
  Kinds kinds;
  for (const MessageKind* kind : allKinds()) {
    if ((derived || !kind->has(MessageKind::kJudged)) && !kind->has(MessageKind::kCommand)) {
      kinds.push_back(kind);
    }
  }
  return kinds;
}

std::int64_t wallMicroseconds() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Loads the scene of a remote twin for the display and monitor nodes here, which have none.
void keepScene(const state::SceneText& scene, const ros::NodeHandle& twin) {
  if (twin.hasParam("scene")) {
    return;
  }
  try {
    twin.setParam("scene", fromYaml(readYamlText(fmt::format("{}", fmt::join(scene.line, "\n")),
                                                 scene.source, "a scene", "systems")));
    twin.setParam("scene_file", scene.source);
    ROS_INFO("%s is the scene of the twin on LCM", twin.resolveName("scene").c_str());
  } catch (const InputError& why) {
    ROS_WARN_THROTTLE(60.0, "the scene of the twin on LCM cannot be used: %s", why.what());
  }
}

std::string countsOf(const LcmReceiver& receiver) {
  return fmt::format("{} received, {} lost, {} rejected", receiver.received(), receiver.lost(),
                     receiver.rejected());
}

class BridgeDiagnostics {
 public:
  void summarize(const LcmReceiver& receiver, const RosTopics& topics, const NewestStates& states,
                 diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const double now = ros::SteadyTime::now().toSec();
    const bool missed = missed_.roseLately(receiver.lost() + receiver.rejected(), now);
    status.summary(missed ? DiagnosticStatus::WARN : DiagnosticStatus::OK, countsOf(receiver));
    if (ros_lost_.roseLately(topics.lost(), now)) {
      status.mergeSummary(DiagnosticStatus::WARN,
                          "a subscriber of " + topics.lostLast() + " is too slow");
    }
    status.add("received", receiver.received());
    status.add("lost", receiver.lost());
    status.add("rejected", receiver.rejected());
    status.add("last rejection", receiver.refused().last());
    status.add("messages lost by slow subscribers", topics.lost());
    status.add("superseded by newer ones", states.leftOut());
    for (const double percent : {50.0, 99.0, 100.0}) {
      status.add(fmt::format("time from reception to publication, {:g} % [s]", percent),
                 static_cast<double>(states.latency().percentile(percent)) * 1.0e-9);
    }
    for (const auto& [name, count] : receiver.channels()) {
      status.add(name, fmt::format("{} received, {} lost, {} out of order", count.received,
                                   count.steps.lost(), count.steps.late()));
    }
  }

 private:
  RisingCount missed_, ros_lost_;
};

void run() {
  LcmBridgeParameters settings;
  table(settings).read();
  const std::string& url = settings.lcm_url;
  const std::string& prefix = settings.lcm_prefix;
  LcmBridge bridge(ros::NodeHandle(twinNamespace()), settings.derived);
  NewestStates states(
      std::chrono::microseconds(settings.newest > 0.0 ? std::llround(1.0e6 / settings.newest) : 0),
      [&bridge](const Message& message) { bridge.publish(message); }, wallMicroseconds);
  DuplicatePublishers rivals(prefix);
  RunFilter runs;
  std::unique_ptr<LcmReceiver> receiver;
  receiver = std::make_unique<LcmReceiver>(
      openLcm(url), kindsToTell(settings.derived),
      [&](const Message& message) {
        if (const auto* loop = std::get_if<state::LoopStatistics>(&message)) {
          rivals.take(*loop);
        } else if (const auto* scene = std::get_if<state::SceneText>(&message)) {
          keepScene(*scene, ros::NodeHandle(twinNamespace()));
        }
        if (runs.take(message, ros::SteadyTime::now().toSec())) {
          states.take(message, receiver->arrived());
        }
      },
      prefix);

  MasterWatch master;
  diagnostic_updater::Updater diagnostics;
  diagnostics.setHardwareID("LCM " + url);
  BridgeDiagnostics counts;
  diagnostics.add("received from LCM", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    counts.summarize(*receiver, bridge.topics(), states, status);
    status.add("ignored, of other runs", runs.ofOthers());
  });
  const RefusalReport refused_payloads(diagnostics, {&receiver->refused()});
  reportMaster(master, diagnostics);
  rivals.report(diagnostics);
  ChangedParameters parameters(master);
  parameters.report(diagnostics);

  ros::NodeHandle node("~");
  using Trigger = std_srvs::Trigger;
  const auto ready = node.advertiseService<Trigger::Request, Trigger::Response>(
      "ready", [&receiver](Trigger::Request&, Trigger::Response& response) {
        response.success = true;
        response.message = countsOf(*receiver);
        return true;
      });

  // Wall time: simulated time may be constant, or come from the log.
  ros::WallTime next_report = ros::WallTime::now();
  while (ros::ok() && !stopRequested()) {
    receiver->receive(states.nextDue(kPoll));
    states.tellDue();
    ros::spinOnce();
    if (ros::WallTime::now() >= next_report) {
      next_report = ros::WallTime::now() + kReportPeriod;
      diagnostics.force_update();
    }
  }
  master.stop();
  ros::shutdown();
  fmt::print("lcm_bridge_node: {}\n", countsOf(*receiver));
  for (const auto& [name, count] : receiver->channels()) {
    fmt::print("  {}: {} received, {} lost\n", name, count.received, count.steps.lost());
  }
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "lcm_bridge_node", whirl_twin::helpOf(whirl_twin::table),
                             whirl_twin::run);
}
