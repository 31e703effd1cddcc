#include "twin/step_times.h"

#include <algorithm>

namespace whirl_twin {

namespace {

constexpr std::int64_t kLook = 25;        // [ns], duration of a clock reading
constexpr std::int64_t kMinShare = 1000;  // period over the time of clock readings

template <class Value>
void add(std::atomic<Value>& sum, Value more) noexcept {
  sum.store(sum.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
}

}  // namespace

StepTimes::StepTimes(std::size_t parts, std::int64_t period)
    : parts_(parts),
      period_(period),
      stride_(std::max<std::int64_t>(
          1, static_cast<std::int64_t>(parts + 1) * kLook * kMinShare / period)) {}

StepTimes::Taken StepTimes::of(std::size_t part) const noexcept {
  const Part& of = parts_[part];
  const std::uint64_t count = of.count.load(std::memory_order_relaxed);
  Taken taken;
  taken.mean = count == 0 ? 0.0
                          : static_cast<double>(of.sum.load(std::memory_order_relaxed)) /
                                static_cast<double>(count);
  taken.longest = of.longest.load(std::memory_order_relaxed);
  taken.long_steps = of.long_steps.load(std::memory_order_relaxed);
  return taken;
}

void StepTimes::beginCycle() noexcept {
  begun_ = 0;
  if (reset_requested_.load(std::memory_order_relaxed)) {
    reset_requested_.store(false, std::memory_order_relaxed);
    for (Part& part : parts_) {
      part.count.store(0, std::memory_order_relaxed);
      part.sum.store(0, std::memory_order_relaxed);
      part.longest.store(0, std::memory_order_relaxed);
      part.long_steps.store(0, std::memory_order_relaxed);
    }
  }
}

void StepTimes::endStep() noexcept {
  for (Part& part : parts_) {
    add(part.count, std::uint64_t{1});
    add(part.sum, part.step);
    if (part.step > part.longest.load(std::memory_order_relaxed)) {
      part.longest.store(part.step, std::memory_order_relaxed);
    }
    part.cycle += part.step;
    part.step = 0;
  }
}

void StepTimes::endCycle(std::int64_t scheduled) noexcept {
  if (begun_ == 0) {
    return;
  }
  const bool too_late = marked_ >= scheduled + period_;
  const bool woken_late = begun_ - scheduled > marked_ - begun_;
  if (too_late && !woken_late) {
    const auto most =
        std::max_element(parts_.begin(), parts_.end(),
                         [](const Part& a, const Part& b) { return a.cycle < b.cycle; });
    add(most->long_steps, std::uint64_t{1});
  }
  for (Part& part : parts_) {
    part.cycle = 0;
  }
}

}  // namespace whirl_twin
