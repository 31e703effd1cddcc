// lcm_recorder_node: records the LCM channels TWIN_* of a twin as an LCM log, until interrupted.
// Private parameters:
//   ~log         the file to write
//   ~lcm_url     where to listen (default: channels.h)
//   ~lcm_prefix  what the channels begin with (default: TWIN_, or the node's namespace in capitals)
//   ~force       true: overwrite an existing file (default false)
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

using std::chrono::milliseconds;

void run() {
  const ros::NodeHandle node;  // keeps ROS up while the parameters are read
  requireKnownParameters({"log", "lcm_url", "lcm_prefix", "force"});
  const auto log = privateParameter<std::string>("log", "the name of a file", "");
  const auto url = privateParameter<std::string>("lcm_url", "an LCM url", kDefaultLcmUrl);
  const auto force = privateParameter<bool>("force", "true or false", false);
  const std::string prefix = lcmPrefixParameter();
  if (log.empty()) {
    throw Refusal("log: missing; expected the name of a file to write");
  }
  if (!force && std::filesystem::exists(log)) {
    throw Refusal(fmt::format("log: '{}' exists; say force:=true to overwrite it", log));
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
  return whirl_twin::runNode(argc, argv, "lcm_recorder_node", whirl_twin::run);
}
