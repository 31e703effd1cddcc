#include "tools/interrupt.h"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>

#include "tools/commands.h"

namespace whirl_twin {

namespace {

std::atomic<bool> end_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

constexpr suseconds_t kGrace = 700'000;  // µs, to notice the flag

void endNow(int) {
  constexpr char kMessage[] = "twin: interrupted; finished results are kept\n";
  const ssize_t written = ::write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
  static_cast<void>(written);  // a failure cannot be reported any more
  ::_exit(kFailed);
}

void askForTheEnd(int signal) {
  if (end_asked.exchange(true)) {
    endNow(signal);  // asked twice
  }
  std::signal(SIGALRM, endNow);
  const itimerval grace{{0, 0}, {0, kGrace}};
  ::setitimer(ITIMER_REAL, &grace, nullptr);
}

}  // namespace

std::atomic<bool>& catchInterrupts() {
  std::signal(SIGINT, askForTheEnd);
  std::signal(SIGTERM, askForTheEnd);
  return end_asked;
}

bool interrupted() {
  if (!end_asked.load(std::memory_order_relaxed)) {
    return false;
  }
  const itimerval none{};
  ::setitimer(ITIMER_REAL, &none, nullptr);
  return true;
}

}  // namespace whirl_twin
