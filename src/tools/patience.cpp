#include "tools/patience.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <utility>

#include "reports/asked_cost.h"
#include "reports/output.h"

namespace whirl_twin {

namespace {

constexpr std::chrono::milliseconds kWaitBetween{500};
constexpr double kLong = 10.0;  // s, of processor time: unaffected by other load

std::atomic<bool> until_stopped{false};

}  // namespace

void runsUntilStopped() {
  until_stopped.store(true);
}

Patience::Patience(std::string command)
    : command_(std::move(command)), thread_([this] { watch(); }) {}

Patience::~Patience() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Patience::watch() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ended_.wait_for(lock, kWaitBetween, [this] { return end_; })) {
    if (isAnnounced() || until_stopped.load()) {
      return;
    }
    if (processorTime() > kLong) {
      complain(
          fmt::format("{}: running for {:.0f} s; the remaining time is unknown. Ctrl-C stops it\n",
                      command_, processorTime()));
      return;
    }
  }
}

}  // namespace whirl_twin
