#include "nodes/run_node.h"

#include <ros/ros.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>

namespace whirl_twin {

namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

void requestStop(int) {
  stop_requested.store(true);
}

}  // namespace

bool stopRequested() {
  return stop_requested.load();
}

int runNode(int argc, char** argv, const char* name, const std::function<void()>& run) {
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
  try {
    run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: cannot run:\n%s\n", name, error.what());
    return 2;
  }
  return 0;
}

}  // namespace whirl_twin
