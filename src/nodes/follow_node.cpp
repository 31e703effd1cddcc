// follow_node: state estimator of a machine. Subscribes to measurements on ROS or LCM; publishes
// the topics and channels of a simulation, so that monitor, rviz and logs need no change, and in
// addition the measurements and the estimates. The scene is the model, and its sensors describe the
// measurements. Reports accepted and rejected messages on /diagnostics once a second.
// Single-threaded: its output depends on the messages and their order only.
#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/ros.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimation/clock_offset_estimator.h"
#include "estimation/estimator_scene.h"
#include "estimation/estimator_sources.h"
#include "estimation/follow_settings.h"
#include "estimation/state_estimator.h"
#include "nodes/changed_parameters.h"
#include "nodes/duplicate_publishers.h"
#include "nodes/follow_publisher.h"
#include "nodes/machine_input.h"
#include "nodes/node_parameters.h"
#include "nodes/refusal_report.h"
#include "nodes/run_node.h"
#include "nodes/state_publisher.h"
#include "plugins/plugins.h"
#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/ros_parameters.h"
#include "transport/twin_namespace.h"
#include "twin/scene_lines.h"

namespace whirl_twin {
namespace {

struct FollowParameters {
  std::string machine = "/machine", machine_prefix;
  std::string input = "ros";
  double publish_rate = 0.0;
  std::string lcm_url, lcm_prefix;
};

NodeParameters table(FollowParameters& p) {
  NodeParameters all(
      "follow_node",
      "A twin that estimates the state of its machine: receives measurements from ROS or LCM;\n"
      "publishes what simulation_node publishes, with the measurements and the estimated "
      "parameters.\n"
      "The scene (on the parameter server) is the model, its sensors specify what is measured.");
  all.text("machine", p.machine, "", "namespace of the machine's topics measured/...")
      .choice("input", p.input, {"ros", "lcm"}, "source of the measurements")
      .text("machine_prefix", p.machine_prefix, "the machine's namespace in capitals",
            "prefix of the machine's LCM channels")
      .number("publish_rate", p.publish_rate, kPublishRates, "messages of a state per second")
      .lcm(p.lcm_url, p.lcm_prefix)
      .other("follow",
             "what to estimate beside the motion, as in the file of `twin follow --settings`");
  return all;
}

const ros::WallDuration kReportPeriod(1.0);
const ros::WallDuration kSilence(1.0);         // timeout of the machine's messages
const ros::WallDuration kSilenceTelling(0.2);  // between reports of the timeout
const ros::WallDuration kAgainPeriod(10.0);    // of repetition on LCM

FollowSettings followSettings(const BuiltScene& scene) {
  const ros::NodeHandle node("~");
  if (!node.hasParam("follow")) {
    return {};
  }
  const ParameterTree given = parameterTree(node, "follow");
  return readFollowSettings(given.tree, given.source, scene);
}

void report(const MachineInput& input, const FollowPublisher& publisher,
            const StateEstimator& follower, diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(input.taken() == 0 ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                 input.taken() == 0 ? "no measurement received yet"
                                    : fmt::format("{} messages", input.taken()));
  if (input.rejected() > 0) {
    status.mergeSummary(DiagnosticStatus::WARN, fmt::format("{} rejected", input.rejected()));
    status.add("last rejected", input.lastRejection());
  }
  if (const std::string others = input.runs().duplicate(ros::SteadyTime::now().toSec());
      !others.empty()) {
    status.mergeSummary(DiagnosticStatus::WARN, printable(others, others.size()));
  }
  status.add("ignored, of other machines", input.runs().ofOthers());
  status.add("re-initializations", follower.restarts());
  for (const auto& [system, state] : publisher.published()) {
    status.add(
        system,
        fmt::format("{} used, {} rejected, {} invalid, {} late, {} lost, {} repeated", state.used,
                    state.refused, state.invalid, state.late, state.lost, state.repeated));
  }
}

void run() {
  FollowParameters settings;
  table(settings).read();
  ros::NodeHandle node(twinNamespace());
  usePlugins();
  const ParameterTree given = parameterTree(node, "scene");
  Twin twin(readEstimatorScene(given.tree, given.source));
  const auto& [machine, machine_prefix, input, publish_rate, lcm_url, own_prefix] = settings;
  const std::string prefix = machine_prefix.empty() ? lcmPrefixOf(machine) : machine_prefix;
  requireLcmPrefix(prefix);
  if (machine == twinNamespace() || (input == "lcm" && prefix == own_prefix)) {
    throw InputError(
        "machine: namespace and prefix must differ from the twin's, which publishes measurements "
        "under its own");
  }
  const std::int64_t every = stepsToPublish(twin.scene(), publish_rate);
  const FollowSettings estimated = followSettings(twin.built());
  std::vector<std::string> sources;
  for (const EstimatorSource& source : estimatorSources(twin.scene(), estimated)) {
    sources.push_back(source.name);
  }

  const auto generations = std::make_shared<SystemGenerations>(twin);
  FollowPublisher publisher(twin, generations, sources, node, LcmPublisher(lcm_url, own_prefix),
                            sceneText(given.tree, given.source));
  std::int64_t ahead = 0;  // [ns], wall clock minus the machine's clock
  StateEstimator* following = nullptr;
  EstimatorListener listener;
  listener.record = [&](const double* record) {
    publisher.setStamp(following->machineInstant(RecordLayout::step(record)) + ahead);
    publisher.publish(record);
  };
  ClockOffsetEstimator clocks;
  std::int64_t restarts = 0;
  listener.follow = [&](state::FollowState state) {
    state.clock_offset = clocks.offset();
    state.clock_offset_deviation = clocks.deviation();
    state.clock_drift = clocks.drift();
    publisher.publish(state);
  };
  StateEstimator follower(twin, generations, estimated, every, listener);
  following = &follower;
  ros::WallTime heard = ros::WallTime::now();  // of the last message
  const MachineInput::Handler take = [&](const state::Measurement& message) {
    heard = ros::WallTime::now();
    const auto now = static_cast<std::int64_t>(heard.toNSec());
    ahead = now - message.lastInstant();
    clocks.take(message.lastInstant(), now);
    publisher.publish(message);
    follower.take(message);
    publisher.send();
    if (follower.clockSettings() != restarts) {
      restarts = follower.clockSettings();
      clocks.restart();
    }
  };
  std::optional<MachineInput> measurements;
  if (input == "lcm") {
    measurements.emplace(lcm_url, prefix, take);
  } else {
    measurements.emplace(machine, sources, take);
  }

  MasterWatch master({node.resolveName("scene"), node.resolveName("scene_file")});
  diagnostic_updater::Updater diagnostics;
  diagnostics.setHardwareID(machine);
  diagnostics.add("measurements", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    report(*measurements, publisher, follower, status);
  });
  const RefusalReport refused_payloads(diagnostics,
                                       {measurements ? measurements->refusedPayloads() : nullptr});
  reportMaster(master, diagnostics);
  ChangedParameters parameters(master);
  parameters.report(diagnostics);
  ROS_INFO("estimating the state of %s by %s", machine.c_str(), input.c_str());
  ros::WallTime next_report = ros::WallTime::now();
  ros::WallTime next_silence = next_report;
  ros::WallTime next_again = next_report + kAgainPeriod;
  while (ros::ok() && !stopRequested()) {
    measurements->receive();
    const ros::WallTime now = ros::WallTime::now();
    if (now - heard > kSilence && now >= next_silence) {
      next_silence = now + kSilenceTelling;
      publisher.publishSilence((now - heard).toSec(), twin.scene().stepSeconds());
    }
    if (now >= next_report) {
      next_report = now + kReportPeriod;
      diagnostics.force_update();
    }
    if (now >= next_again) {
      next_again = now + kAgainPeriod;
      publisher.tellAgain();
    }
  }
  master.stop();
  ros::shutdown();
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "follow_node", whirl_twin::helpOf(whirl_twin::table),
                             whirl_twin::run);
}
