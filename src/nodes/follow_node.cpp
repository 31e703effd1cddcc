// follow_node: a twin that follows its machine. Measurements in, from ROS or LCM; out the topics
// and channels of a simulation, so that monitor, rviz and logs need no change, with what was
// measured and what has been learned beside them. The scene is the model, and its sensors say what
// is measured. Says what it has taken and what not on /diagnostics once a second. It has one
// thread: what it tells depends on the messages and their order alone.
#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/ros.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimation/clock_watch.h"
#include "estimation/follow_settings_reader.h"
#include "estimation/followed_scene.h"
#include "estimation/followed_sources.h"
#include "estimation/follower.h"
#include "nodes/changed_parameters.h"
#include "nodes/follow_publisher.h"
#include "nodes/machine_input.h"
#include "nodes/private_parameter.h"
#include "nodes/publish_rate.h"
#include "nodes/refusal_report.h"
#include "nodes/rival_report.h"
#include "nodes/run_node.h"
#include "plugins/plugins.h"
#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/ros_parameters.h"
#include "transport/twin_namespace.h"
#include "twin/scene_lines.h"

namespace whirl_twin {
namespace {

constexpr const char* kHelp =
    "usage: follow_node [_PARAMETER:=VALUE...] [NAME:=VALUE...]\n"
    "A twin that estimates the state of its machine: receives measurements from ROS or LCM;\n"
    "publishes what simulation_node publishes, with the measurements and the estimated "
    "parameters.\n"
    "The scene (on the parameter server) is the model, its sensors specify what is measured.\n"
    "\n"
    "private parameters (_NAME:=VALUE on the command line, or <param> in a launch file):\n"
    "  ~machine         namespace of the machine's topics measured/..., default /machine\n"
    "  ~input           ros or lcm, default ros: source of the measurements\n"
    "  ~machine_prefix  prefix of the machine's LCM channels, default its namespace in capitals\n"
    "  ~publish_rate    Hz, default 0: every step of the scene\n"
    "  ~lcm_url         default udpm://239.255.76.67:7667?ttl=0; empty: no LCM\n"
    "  ~lcm_prefix      prefix of its LCM channels, default TWIN_, or its namespace in capitals\n"
    "  ~follow          what to estimate beside the motion, as in the file of\n"
    "                   `twin follow --settings`\n";

const ros::WallDuration kReportPeriod(1.0);
const ros::WallDuration kSilence(1.0);         // of the machine, from which on it is told
const ros::WallDuration kSilenceTelling(0.2);  // from one such message to the next
const ros::WallDuration kAgainPeriod(10.0);    // of what LCM does not latch

FollowSettings readSettings(const BuiltScene& scene) {
  const ros::NodeHandle node("~");
  if (!node.hasParam("follow")) {
    return {};
  }
  const ParameterTree given = parameterTree(node, "follow");
  return readFollowSettings(given.tree, given.source, scene);
}

void report(const MachineInput& input, const FollowPublisher& publisher, const Follower& follower,
            diagnostic_updater::DiagnosticStatusWrapper& status) {
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
  for (const auto& [system, told] : publisher.told()) {
    status.add(
        system,
        fmt::format("{} used, {} rejected, {} invalid, {} late, {} lost, {} repeated", told.used,
                    told.refused, told.invalid, told.late, told.lost, told.repeated));
  }
}

void run() {
  requireKnownParameters(
      {"machine", "input", "machine_prefix", "publish_rate", "lcm_url", "lcm_prefix", "follow"});
  ros::NodeHandle node(twinNamespace());
  usePlugins();
  const ParameterTree given = parameterTree(node, "scene");
  Twin twin(readFollowedScene(given.tree, given.source));
  const auto machine =
      privateParameter<std::string>("machine", "the machine's namespace", "/machine");
  const auto input = privateParameter<std::string>("input", "ros or lcm", "ros");
  if (input != "ros" && input != "lcm") {
    throw Refusal(fmt::format("input: must be ros or lcm, found '{}'", printable(input)));
  }
  const auto lcm_url =
      privateParameter<std::string>("lcm_url", "an LCM URL, or nothing", kDefaultLcmUrl);
  const auto prefix = privateParameter<std::string>("machine_prefix", "letters, digits and _",
                                                    lcmPrefixOf(machine));
  requireLcmPrefix(prefix);
  const std::string own_prefix = lcmPrefixParameter();
  if (machine == twinNamespace() || (input == "lcm" && prefix == own_prefix)) {
    throw Refusal(
        "machine: namespace and prefix must differ from the twin's, which publishes measurements "
        "under its own");
  }
  const std::int64_t every = stepsToPublish(twin.scene());
  const FollowSettings settings = readSettings(twin.built());
  std::vector<std::string> sources;
  for (const FollowedSource& source : followedSources(twin.scene(), settings)) {
    sources.push_back(source.name);
  }

  const auto generations = std::make_shared<SystemGenerations>(twin);
  FollowPublisher publisher(twin, generations, sources, node, LcmPublisher(lcm_url, own_prefix),
                            sceneText(given.tree, given.source));
  std::int64_t ahead = 0;  // [ns], of the wall clock before the machine's
  Follower* following = nullptr;
  FollowerListener listener;
  listener.record = [&](const double* record) {
    publisher.setStamp(following->machineInstant(RecordLayout::step(record)) + ahead);
    publisher.publish(record);
  };
  ClockWatch clocks;
  std::int64_t restarts = 0;
  listener.follow = [&](state::FollowState told) {
    told.clock_offset = clocks.offset();
    told.clock_offset_deviation = clocks.deviation();
    told.clock_drift = clocks.drift();
    publisher.publish(told);
  };
  Follower follower(twin, generations, settings, every, listener);
  following = &follower;
  ros::WallTime heard = ros::WallTime::now();  // the last message
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
  return whirl_twin::runNode(argc, argv, "follow_node", whirl_twin::kHelp, whirl_twin::run);
}
