#include "nodes/run_node.h"

#include <ros/ros.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <thread>

#include "messages/refusal.h"
#include "nodes/node_help.h"

namespace whirl_twin {

namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

/// The second signal of a kind ends the process at once, in case something does not look.
void requestStop(int signal) {
  stop_requested.store(true);
  std::signal(signal, SIG_DFL);
}

/// False if a signal came first. (Without a master a first topic or service waits for ever, and is
/// deaf to stopRequested(): so the wait is here.)
bool waitForMaster(const char* name) {
  for (bool told = false; !ros::master::check(); told = true) {
    if (!told) {
      std::fprintf(stderr, "%s: waiting for a ROS master at %s\n", name,
                   ros::master::getURI().c_str());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (stopRequested()) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool stopRequested() {
  return stop_requested.load();
}

int runNode(int argc, char** argv, const char* name, const char* help,
            const std::function<void()>& run) {
  if (toldHelp(argc, argv, help)) {
    return 0;
  }
  try {
    ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
    std::signal(SIGINT, requestStop);
    std::signal(SIGTERM, requestStop);
    if (waitForMaster(name)) {
      const ros::NodeHandle
          kept;  // with the last one, as that by which a parameter is read, ROS ends
      run();
    }
  } catch (const RunFailure& failure) {
    std::fprintf(stderr, "%s: failed:\n%s\n", name, failure.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: cannot run:\n%s\n", name, error.what());
    return 2;
  }
  return 0;
}

}  // namespace whirl_twin
