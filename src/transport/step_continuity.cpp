#include "transport/step_continuity.h"

#include <algorithm>

namespace whirl_twin {
namespace {

/// Number of distinct differences kept; a channel in order has one, more indicate corrupt steps.
constexpr std::size_t kMaxDifferences = 1000;

}  // namespace

void StepContinuity::add(std::int64_t step) {
  const bool restarted = before_ >= 0 && step > before_ && step <= last_;
  if (restarted) {  // two successive steps before the window: the count resumes there
    --late_;
    beginAnew();
    window_ = {before_, step};
    before_ = -1;
    return;
  }
  before_ = -1;
  if (window_.empty() || step > window_.back()) {
    window_.push_back(step);
    settle(kWindow);
    return;
  }
  const auto place = std::lower_bound(window_.begin(), window_.end(), step);
  const bool known = *place == step || step == last_;
  if (step == 0 && (known || last_ >= 0)) {  // the first step of a run
    beginAnew();
    window_ = {step};
  } else if (known) {
    ++repeated_;
  } else {
    ++late_;
    if (step > last_) {
      window_.insert(place, step);
      settle(kWindow);
    } else {
      before_ = step;
    }
  }
}

void StepContinuity::beginAnew() {
  settle(0);
  last_ = -1;
  ++backward_;
}

/// Removes the lowest steps from the window until `left` remain.
void StepContinuity::settle(std::size_t left) {
  for (; window_.size() > left; window_.pop_front()) {
    differences_.count(last_, window_.front());
    last_ = window_.front();
  }
}

StepContinuity::Differences StepContinuity::all() const {
  Differences all = differences_;
  std::int64_t from = last_;
  for (const std::int64_t step : window_) {
    all.count(from, step);
    from = step;
  }
  return all;
}

void StepContinuity::Differences::count(std::int64_t from, std::int64_t to) {
  if (from < 0) {
    return;
  }
  if (forward.size() < kMaxDifferences || forward.count(to - from) != 0) {
    ++forward[to - from];
  } else {
    ++scattered;
  }
}

// At least 1 if there is a forward step: each was counted on arrival.
std::int64_t StepContinuity::Differences::stride() const {
  std::int64_t stride = 0;
  std::uint64_t most = 0;
  for (const auto& [difference, count] : forward) {
    if (count > most) {
      stride = difference;
      most = count;
    }
  }
  return stride;
}

std::int64_t StepContinuity::stride() const {
  return all().stride();
}

std::uint64_t StepContinuity::gaps() const {
  const Differences found = all();
  const std::int64_t stride_now = found.stride();
  std::uint64_t gaps = found.scattered;
  for (const auto& [difference, count] : found.forward) {
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): see stride().
    gaps += difference / stride_now >= 2 ? count : 0;
  }
  return gaps;
}

std::uint64_t StepContinuity::lost() const {
  const Differences found = all();
  const std::int64_t stride_now = found.stride();
  std::uint64_t lost = 0;
  for (const auto& [difference, count] : found.forward) {
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): see stride().
    if (difference / stride_now >= 2) {
      lost += count * static_cast<std::uint64_t>(difference / stride_now - 1);
    }
  }
  return lost;
}

}  // namespace whirl_twin
