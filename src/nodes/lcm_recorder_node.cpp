// lcm_recorder_node: records the LCM channels TWIN_* of a twin as an LCM log, until interrupted.
#include <fmt/format.h>
#include <ros/ros.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

#include "nodes/private_parameter.h"
#include "nodes/run_node.h"
#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_recorder.h"
#include "transport/master_watch.h"

namespace whirl_twin {
namespace {

constexpr const char* kHelp =
    "usage: lcm_recorder_node [_PARAMETER:=VALUE...] [NAME:=VALUE...]\n"
    "Records the LCM channels of a twin as an LCM log, until it is interrupted.\n"
    "\n"
    "private parameters (_NAME:=VALUE on the command line, or <param> in a launch file):\n"
    "  ~log         the file to write\n"
    "  ~lcm_url     where to listen, default udpm://239.255.76.67:7667?ttl=0\n"
    "  ~lcm_prefix  prefix of the channels, default TWIN_, or its namespace in capitals\n"
    "  ~force       true or false, default false: overwrite an existing file\n";

using std::chrono::milliseconds;

void run() {
  const ros::NodeHandle node;  // keeps ROS up while the parameters are read
  requireKnownParameters({"log", "lcm_url", "lcm_prefix", "force"});
  const auto log = privateParameter<std::string>("log", "the name of a file", "");
  const auto url = privateParameter<std::string>("lcm_url", "an LCM URL", kDefaultLcmUrl);
  const auto force = privateParameter<bool>("force", "true or false", false);
  const std::string prefix = lcmPrefixParameter();
  if (log.empty()) {
    throw Refusal("log: missing; must be the name of a file to write");
  }
  if (!force && std::filesystem::exists(log)) {
    throw Refusal(fmt::format("log: '{}' exists; set force:=true to overwrite it", log));
  }
  MasterWatch master;
  const auto lcm = openLcm(url);
  LcmRecorder recorder(lcm, prefix + ".*", log);
  fmt::print("recording {}* from {} to {}\n", prefix, url, log);
  std::fflush(stdout);
  while (ros::ok() && !stopRequested()) {
    recorder.record(milliseconds(50));
  }
  master.stop();
  constexpr int kAll = 100000;
  recorder.record(milliseconds(0), kAll);  // what arrived before the interruption
  fmt::print("{} events recorded to {}\n", recorder.recorded(), log);
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "lcm_recorder_node", whirl_twin::kHelp, whirl_twin::run);
}
