#include "transport/step_continuity.h"

namespace whirl_twin {
namespace {

/// Different differences kept; a channel in order has one, so more are a sign of damage anyway.
constexpr std::size_t kMaxDifferences = 1000;

}  // namespace

void StepContinuity::add(std::int64_t step) {
  const std::int64_t before = last_;
  last_ = step;
  if (before < 0) {
    return;
  }
  if (step == before) {
    ++repeated_;
  } else if (step < before) {
    ++backward_;
  } else if (forward_.size() < kMaxDifferences || forward_.count(step - before) != 0) {
    ++forward_[step - before];
  } else {
    ++scattered_;
  }
}

// At least 1 where there is a forward step: each was counted when it was seen.
std::int64_t StepContinuity::stride() const {
  std::int64_t stride = 0;
  std::uint64_t most = 0;
  for (const auto& [difference, count] : forward_) {
    if (count > most) {
      stride = difference;
      most = count;
    }
  }
  return stride;
}

std::uint64_t StepContinuity::gaps() const {
  const std::int64_t stride_now = stride();
  std::uint64_t gaps = scattered_;
  for (const auto& [difference, count] : forward_) {
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): see stride().
    gaps += difference / stride_now >= 2 ? count : 0;
  }
  return gaps;
}

std::uint64_t StepContinuity::lost() const {
  const std::int64_t stride_now = stride();
  std::uint64_t lost = 0;
  for (const auto& [difference, count] : forward_) {
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): see stride().
    if (difference / stride_now >= 2) {
      lost += count * static_cast<std::uint64_t>(difference / stride_now - 1);
    }
  }
  return lost;
}

}  // namespace whirl_twin
