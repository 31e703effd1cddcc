// command_bridge_node: forwards commands between ROS and LCM. On the side of the simulation, it
// calls the services of the simulation for commands that arrive by LCM, from one commander at a
// time; on the side of the operators, it offers these services, and sends their requests by LCM.
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
#include "nodes/duplicate_publishers.h"
#include "nodes/lcm_command_server.h"
#include "nodes/node_parameters.h"
#include "nodes/refusal_report.h"
#include "nodes/rising_count.h"
#include "nodes/run_node.h"

namespace whirl_twin {
namespace {

constexpr std::chrono::milliseconds kPoll{20};
constexpr int kThreads = 4;  // concurrent services
const ros::WallDuration kReportPeriod(1.0);
struct BridgeParameters {
  std::string role = "take";
  std::string lcm_url, lcm_prefix;
  std::string simulation = "simulation_node";
  double lease = 5.0, timeout = 5.0;  ///< [s]
  bool played = false;
};

NodeParameters table(BridgeParameters& p) {
  NodeParameters all(
      "command_bridge_node",
      "Commands to a twin between ROS and LCM: pause, resume, reset, step, set_speed, "
      "set_parameter,\nset_input, set_real_time_factor. Needs no scene.");
  all.choice("role", p.role, {"take", "send"},
             "take: from LCM to the services of the simulation; send: from its own services to LCM")
      .lcm(p.lcm_url, p.lcm_prefix, true)
      .text("simulation", p.simulation, "", "take: the node whose services are called")
      .number("lease", p.lease, {0.0, 3600.0, "s"},
              "take: time after a command during which other senders are refused")
      .flag("played", p.played,
            "take: also accept commands sent more than 5 s ago, as those of a log are")
      .number("timeout", p.timeout, {0.1, 3600.0, "s"}, "send: longest wait for an answer");
  return all;
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
  BridgeParameters settings;
  table(settings).read();
  CommandChannels channels(settings.lcm_url, settings.lcm_prefix);
  std::unique_ptr<LcmCommandServer> taker;
  std::unique_ptr<CommandSender> sender;
  if (settings.role == "take") {
    taker = std::make_unique<LcmCommandServer>(channels, nameOfThisProcess(),
                                               ros::names::resolve(settings.simulation),
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
        status.mergeSummary(
            DiagnosticStatus::WARN,
            "commands are not answered within ~timeout: check that a bridge with ~role take "
            "uses the same ~lcm_url and ~lcm_prefix");
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
  return whirl_twin::runNode(argc, argv, "command_bridge_node",
                             whirl_twin::helpOf(whirl_twin::table), whirl_twin::run);
}
