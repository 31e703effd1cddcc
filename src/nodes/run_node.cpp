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

#include "messages/names.h"
#include "messages/refusal.h"
#include "nodes/node_parameters.h"

namespace whirl_twin {

namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

/// [s] from a signal to the end of the process, whatever it does: roslaunch kills after 15 s
/// without a message.
constexpr unsigned kLongestEnd = 12;

/// Something blocks, as a master that accepts a call and does not answer it.
void endNow(int) {
  constexpr char kText[] = "the node did not end within 12 s of the signal: the process ends now\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kText, sizeof kText - 1);
  std::_Exit(1);
}

/// The second signal of a kind ends the process at once.
void requestStop(int signal) {
  stop_requested.store(true);
  std::signal(signal, SIG_DFL);
  ::alarm(kLongestEnd);
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

/// What a node has, to end by itself, once it is asked to.
constexpr auto kGrace = std::chrono::seconds(5);

/// Ends a node that is asked to stop and cannot, for the master went away under it: a topic or a
/// service that is being registered asks again for ever, and is deaf to stopRequested(), but not to
/// ROS's own end.
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
  std::thread thread_;  // last: it looks at the others
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
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is like a disk that is full
    if (waitForMaster(name)) {
      const ros::NodeHandle
          kept;  // with the last one, as that by which a parameter is read, ROS ends
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
