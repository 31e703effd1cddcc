#include "tools/interrupt.h"

#include <csignal>

namespace whirl_twin {

namespace {

std::atomic<bool> end_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

}  // namespace

std::atomic<bool>& catchInterrupts() {
  const auto ask = [](int) { end_asked.store(true); };
  std::signal(SIGINT, ask);
  std::signal(SIGTERM, ask);
  return end_asked;
}

bool interrupted() {
  return end_asked.load(std::memory_order_relaxed);
}

}  // namespace whirl_twin
