#include "tools/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace whirl_twin {

namespace {

constexpr std::size_t kWidth = 40;
constexpr std::chrono::milliseconds kInterval{100};

/// Onto the terminal, with its control characters.
void draw(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressBar::ProgressBar(std::int64_t steps, bool results_on_standard_output)
    : steps_(steps),
      on_(::isatty(STDERR_FILENO) != 0 &&
          !(results_on_standard_output && ::isatty(STDOUT_FILENO) != 0)) {}

void ProgressBar::show(std::int64_t step) {
  if (!on_) {
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) {
    return;
  }
  next_ = now + kInterval;
  const double part = static_cast<double>(step) / static_cast<double>(steps_);
  const auto filled = static_cast<std::size_t>(part * kWidth);
  draw(fmt::format("\r[{}{}] {:3.0f} %", std::string(filled, '#'),
                   std::string(kWidth - filled, ' '), 100.0 * part));
  drawn_ = true;
}

void ProgressBar::clear() {
  if (drawn_) {
    draw("\r\033[K");
    drawn_ = false;
  }
}

}  // namespace whirl_twin
