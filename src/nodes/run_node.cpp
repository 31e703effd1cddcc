#include "nodes/run_node.h"

#include <ros/ros.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>

#include "messages/input_error.h"
#include "messages/names.h"
#include "nodes/node_parameters.h"

namespace whirl_twin {

namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

/// [s] Limit from a signal to the end of the process: roslaunch kills it after 15 s without a
/// message.
constexpr unsigned kMaxEnd = 12;

/// For a call that blocks, for example to a master that accepts it but does not answer.
void endNow(int) {
  constexpr char kText[] = "the node did not end within 12 s of the signal: the process ends now\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kText, sizeof kText - 1);
  std::_Exit(1);
}

/// A second signal of the same kind ends the process at once.
void requestStop(int signal) {
  stop_requested.store(true);
  std::signal(signal, SIG_DFL);
  ::alarm(kMaxEnd);
}

/// False if a signal arrived first. (Without a master, the registration of the first topic or
/// service would block and ignore stopRequested(): hence the wait here.)
bool waitForMaster(const char* name) {
  for (bool logged = false; !ros::master::check(); logged = true) {
    if (!logged) {
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

/// Time for a node to stop by itself after a stop request.
constexpr auto kGrace = std::chrono::seconds(5);

/// Stops a node that ignores a stop request because the master is gone: the registration of a topic
/// or a service retries forever and ignores stopRequested(), but ends with ROS's shutdown.
class EndWithoutMaster {
 public:
  EndWithoutMaster() : thread_([this] { watch(); }) {}
  ~EndWithoutMaster() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      over_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

 private:
  bool isOverWithin(std::chrono::milliseconds time) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, time, [this] { return over_; });
  }

  void watch() {
    while (!isOverWithin(std::chrono::milliseconds(500))) {
      if (stopRequested() && !isOverWithin(kGrace) && !ros::master::check()) {
        ros::requestShutdown();
        return;
      }
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread thread_;  // last: it uses the other members
};

}  // namespace

bool stopRequested() {
  return stop_requested.load();
}

int runNode(int argc, char** argv, const char* name, const std::string& help,
            const std::function<void()>& run) {
  if (printsHelp(argc, argv, help)) {
    return 0;
  }
  try {
    ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
    std::signal(SIGINT, requestStop);
    std::signal(SIGTERM, requestStop);
    std::signal(SIGALRM, endNow);
    std::signal(SIGXFSZ, SIG_IGN);  // a file at its size limit gives an error, as on a full disk
    if (waitForMaster(name)) {
      const ros::NodeHandle kept;  // ROS shuts down with its last NodeHandle, maybe a temporary one
      const EndWithoutMaster end_without_master;
      run();
    }
  } catch (const RunFailure& failure) {
    std::fprintf(stderr, "%s: failed:\n%s\n", name, printableLines(failure.what()).c_str());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: cannot run:\n%s\n", name, printableLines(error.what()).c_str());
    return 2;
  }
  return 0;
}

}  // namespace whirl_twin
