#include "tools/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "reports/asked_cost.h"
#include "tools/interrupt.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kWidth = 40;
constexpr std::chrono::milliseconds kInterval{100};
constexpr double kPaceCheck = 0.02;       // s, between two polls
constexpr std::int64_t kMaxSteps = 1024;  // likewise: a poll costs as much as a cheap step
constexpr double kJudged = 1.0;           // s, after which the pace is measured

/// Prints to the terminal, with its control characters.
void putOnTerminal(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressBar::ProgressBar(std::string asked, std::int64_t steps, bool results_on_standard_output,
                         bool insist)
    : asked_(std::move(asked)),
      steps_(std::max<std::int64_t>(1, steps)),
      insist_(insist),
      on_(::isatty(STDERR_FILENO) != 0 &&
          !(results_on_standard_output && ::isatty(STDOUT_FILENO) != 0)),
      start_(processorTime()) {}

std::int64_t ProgressBar::show(std::int64_t step) {
  if (step <= 0) {
    return 1;
  }
  const double taken = processorTime() - start_;
  const double of_one = taken / static_cast<double>(step);
  if (!judged_ && taken > kJudged) {
    judged_ = true;
    clear();
    tell({of_one * static_cast<double>(steps_), 0.0, asked_}, insist_);
  }
  const auto now = std::chrono::steady_clock::now();
  if (on_ && now >= next_) {
    next_ = now + kInterval;
    draw(static_cast<double>(step) / static_cast<double>(steps_),
         of_one * static_cast<double>(steps_ - step));
  }
  return static_cast<std::int64_t>(
      std::clamp(kPaceCheck / std::max(of_one, 1.0e-9), 1.0, static_cast<double>(kMaxSteps)));
}

void ProgressBar::draw(double part, double left) {
  const auto filled = static_cast<std::size_t>(std::min(part, 1.0) * kWidth);
  putOnTerminal(fmt::format("\r[{}{}] {:3.0f} %, {} remaining\033[K", std::string(filled, '#'),
                            std::string(kWidth - filled, ' '), 100.0 * part, durationText(left)));
  drawn_ = true;
}

void ProgressBar::clear() {
  if (drawn_) {
    putOnTerminal("\r\033[K");
    drawn_ = false;
  }
}

void TerminalProgress::begin(const std::string& asked, std::int64_t steps, bool insist) {
  bar_.emplace(asked, steps, results_on_standard_output_, insist);
}

void TerminalProgress::clear() {
  if (bar_) {
    bar_->clear();
  }
}

bool TerminalProgress::interrupted() {
  return whirl_twin::interrupted();
}

std::atomic<bool>& TerminalProgress::stop() {
  return catchInterrupts();
}

}  // namespace whirl_twin
