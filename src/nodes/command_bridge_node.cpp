// command_bridge_node: commands to a twin between ROS and LCM. Where the simulation is, it takes
// commands that come by LCM to the services of the simulation, for one commander at a time; where
// people are, it has those services, and sends what they are asked for by LCM.
#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/ros.h>

#include <chrono>
#include <memory>
#include <string>

#include "nodes/changed_parameters.h"
#include "nodes/command_channels.h"
#include "nodes/command_sender.h"
#include "nodes/command_taker.h"
#include "nodes/private_parameter.h"
#include "nodes/refusal_report.h"
#include "nodes/rising_count.h"
#include "nodes/rival_report.h"
#include "nodes/run_node.h"

namespace whirl_twin {
namespace {

constexpr const char* kHelp =
    "usage: command_bridge_node [_PARAMETER:=VALUE...] [NAME:=VALUE...]\n"
    "Commands to a twin between ROS and LCM: pause, resume, reset, step, set_speed, "
    "set_parameter,\n"
    "set_input, set_real_time_factor. Needs no scene.\n"
    "\n"
    "private parameters (_NAME:=VALUE on the command line, or <param> in a launch file):\n"
    "  ~role        take: from LCM to the services of the simulation, the default; send: from its\n"
    "               own services to LCM\n"
    "  ~lcm_url     default udpm://239.255.76.67:7667?ttl=0\n"
    "  ~lcm_prefix  prefix of the channels, default TWIN_, or its namespace in capitals\n"
    "  ~simulation  take: the node whose services are called, default simulation_node\n"
    "  ~lease       take: s after a command during which other senders are refused, 0 to 3600,\n"
    "               default 5\n"
    "  ~played      take: true or false, default false: also accept commands sent more than 5 s\n"
    "               ago, as those of a log are\n"
    "  ~timeout     send: s to wait for an answer, 0.1 to 3600, default 5\n";

constexpr std::chrono::milliseconds kPoll{20};
constexpr int kThreads = 4;  // services at a time
const ros::WallDuration kReportPeriod(1.0);
constexpr double kLongest = 3600.0;  // s
constexpr double kShortestTimeout = 0.1;

struct BridgeSettings {
  bool takes;
  std::string lcm_url, lcm_prefix, simulation;
  double lease;  ///< [s]
  bool played;
  double timeout;  ///< [s]
};

double secondsFrom(const char* name, double shortest, double fallback) {
  const double value = privateParameter(name, "a number of seconds", fallback);
  if (!(value >= shortest && value <= kLongest)) {
    throw Refusal(
        fmt::format("{}: must be from {:g} to {:g} s, found {}", name, shortest, kLongest, value));
  }
  return value;
}

BridgeSettings readSettings() {
  requireKnownParameters(
      {"role", "lcm_url", "lcm_prefix", "simulation", "lease", "played", "timeout"});
  BridgeSettings s;
  const auto role = privateParameter<std::string>("role", "take or send", "take");
  if (role != "take" && role != "send") {
    throw Refusal(fmt::format("role: expected take or send, found {}", quoted(role)));
  }
  s.takes = role == "take";
  s.lcm_url = privateParameter<std::string>("lcm_url", "an LCM URL", kDefaultLcmUrl);
  s.lcm_prefix = lcmPrefixParameter();
  s.simulation = ros::names::resolve(
      privateParameter<std::string>("simulation", "the name of a node", "simulation_node"));
  s.lease = secondsFrom("lease", 0.0, 5.0);
  s.played = privateParameter("played", "true or false", false);
  s.timeout = secondsFrom("timeout", kShortestTimeout, 5.0);
  return s;
}

using Status = diagnostic_updater::DiagnosticStatusWrapper;
using diagnostic_msgs::DiagnosticStatus;

void addLatency(const TimingHistogram& latency, Status& status) {
  for (const double percent : {50.0, 99.0, 100.0}) {
    status.add(fmt::format("time from command to answer, {:g} % [s]", percent),
               static_cast<double>(latency.percentile(percent)) * 1.0e-9);
  }
}

void run() {
  const BridgeSettings settings = readSettings();
  CommandChannels channels(settings.lcm_url, settings.lcm_prefix);
  std::unique_ptr<CommandTaker> taker;
  std::unique_ptr<CommandSender> sender;
  if (settings.takes) {
    taker = std::make_unique<CommandTaker>(channels, nameOfThisProcess(), settings.simulation,
                                           settings.lease, settings.played);
  } else {
    sender = std::make_unique<CommandSender>(channels, ros::NodeHandle("~"), nameOfThisProcess(),
                                             settings.timeout);
  }
  MasterWatch master;
  diagnostic_updater::Updater diagnostics;
  diagnostics.setHardwareID("LCM " + settings.lcm_url);
  RisingCount refused;
  diagnostics.add("commands", [&](Status& status) {
    const double now = ros::SteadyTime::now().toSec();
    if (taker) {
      const CommandCounts counts = taker->counts();
      status.summary(DiagnosticStatus::OK,
                     counts.holder.empty() ? "no commander" : counts.holder + " has the command");
      if (refused.roseLately(counts.refused + channels.malformed().total(), now)) {
        status.mergeSummary(DiagnosticStatus::WARN, "commands are refused");
      }
      if (const auto others = taker->others(); !others.empty()) {
        const std::string text = fmt::format(
            "duplicate receiver: {} also executes the commands of {}*: each is executed twice; "
            "stop one of them",
            fmt::join(others, " and "), settings.lcm_prefix);
        ROS_ERROR_THROTTLE(60.0, "%s", text.c_str());
        status.mergeSummary(DiagnosticStatus::ERROR, text);
      }
      status.add("taken", counts.taken);
      status.add("refused", counts.refused);
      status.add("last refusal", counts.last_refusal);
      addLatency(counts.latency, status);
    } else {
      status.summary(DiagnosticStatus::OK, "commands are sent to LCM");
      if (refused.roseLately(sender->unanswered(), now)) {
        status.mergeSummary(DiagnosticStatus::WARN, "commands are not answered");
      }
      status.add("sent", sender->sent());
      status.add("not answered", sender->unanswered());
      addLatency(sender->latency(), status);
    }
    status.add("malformed", channels.malformed().total());
    status.add("last malformed", channels.malformed().last());
  });
  const RefusalReport refused_payloads(diagnostics, {&channels.malformed()});
  reportMaster(master, diagnostics);
  ChangedParameters parameters(master);
  parameters.report(diagnostics);

  ros::AsyncSpinner services(kThreads);
  services.start();
  ros::WallTime next_report = ros::WallTime::now();
  while (ros::ok() && !stopRequested()) {
    channels.receive(kPoll);
    if (ros::WallTime::now() >= next_report) {
      next_report = ros::WallTime::now() + kReportPeriod;
      if (taker) {
        taker->beat();
      }
      diagnostics.force_update();
    }
  }
  services.stop();
  master.stop();
  ros::shutdown();
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "command_bridge_node", whirl_twin::kHelp, whirl_twin::run);
}
