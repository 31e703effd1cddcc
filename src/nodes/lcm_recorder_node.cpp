// lcm_recorder_node: records the LCM channels TWIN_* of a twin as an LCM log, until interrupted.
#include <fmt/format.h>
#include <ros/ros.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

#include "nodes/node_parameters.h"
#include "nodes/run_node.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_recorder.h"
#include "transport/master_watch.h"

namespace whirl_twin {
namespace {

struct RecorderParameters {
  std::string log, lcm_url, lcm_prefix;
  bool force = false;
};

NodeParameters table(RecorderParameters& p) {
  NodeParameters all("lcm_recorder_node",
                     "Records the LCM channels of a twin as an LCM log, until it is interrupted.");
  all.text("log", p.log, "none, it is required", "the file to write")
      .lcm(p.lcm_url, p.lcm_prefix, true)
      .flag("force", p.force, "overwrite an existing file");
  return all;
}

using std::chrono::milliseconds;

void run() {
  const ros::NodeHandle node;  // keeps ROS up while the parameters are read
  RecorderParameters settings;
  table(settings).read();
  const auto& [log, url, prefix, force] = settings;
  if (log.empty()) {
    throw InputError("log: missing; must be the name of a file to write");
  }
  if (!force && std::filesystem::exists(log)) {
    throw InputError(fmt::format("log: '{}' exists; set force:=true to overwrite it", log));
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
  recorder.record(milliseconds(0), kAll);  // events received before the interruption
  fmt::print("{} events recorded to {}\n", recorder.recorded(), log);
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "lcm_recorder_node", whirl_twin::helpOf(whirl_twin::table),
                             whirl_twin::run);
}
