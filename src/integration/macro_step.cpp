#include "integration/macro_step.h"

#include <algorithm>
#include <utility>

namespace whirl_twin {

namespace {

constexpr int kPause = 64;  // long steps

}  // namespace

MacroStep::MacroStep(std::unique_ptr<ReadOffStepper> far, std::unique_ptr<Stepper> near,
                     const StoermerScheme& scheme, const Drive* drive, double length, int count)
    : far_(std::move(far)),
      near_(std::move(near)),
      drive_(drive),
      length_(length),
      count_(count),
      passed_(count),
      state_(2 * far_->dof() + 2) {
  for (int i = 1; i < count; ++i) {
    readings_.emplace_back(scheme, static_cast<double>(i) / count);
  }
}

bool MacroStep::mayStepFar() const noexcept {
  return near_left_ == 0 && (drive_ == nullptr || drive_->constantFor(length_));
}

/// Stores the state, for the other stepper or to restart the same one.
void MacroStep::keep() noexcept {
  write(state_.data());
  state_.back() = errorSum();
}

void MacroStep::advanceBy(bool far) noexcept {
  work_before_ = {state_[2 * dof()], 0.0};
  errors_before_ = state_.back();
  Stepper& next = far ? static_cast<Stepper&>(*far_) : *near_;
  next.set(state_.data(), state_.data() + dof());
  by_far_ = far;
  passed_ = count_;
}

[[gnu::noinline]] StepStatus MacroStep::begin(double time) noexcept {
  if (mayStepFar()) {
    const bool goes_on =
        by_far_ && passed_ == count_ && (drive_ == nullptr || drive_->piece() == piece_);
    keep();
    if (!goes_on) {
      advanceBy(true);
    }
    if (far_->step(time) == StepStatus::kOk && far_->follows()) {
      passed_ = 1;
      piece_ = drive_ == nullptr ? 0 : drive_->piece();
      return StepStatus::kOk;
    }
    near_left_ = kPause * count_;
    advanceBy(false);
  }
  near_left_ -= near_left_ > 0 ? 1 : 0;
  if (by_far_) {
    keep();
    advanceBy(false);
  }
  return near_->step(time);
}

StepStatus MacroStep::stepPart(double time, std::int64_t from, std::int64_t to) noexcept {
  if (by_far_) {
    keep();
    advanceBy(false);
  }
  return near_->stepPart(time, from, to);
}

void MacroStep::motion(double* out) const noexcept {
  if (by_far_ && passed_ < count_) {
    far_->readOff(readings_[static_cast<std::size_t>(passed_ - 1)], false, out);
  } else {
    (by_far_ ? static_cast<const Stepper&>(*far_) : *near_).motion(out);
  }
}

void MacroStep::write(double* out) const noexcept {
  if (by_far_ && passed_ < count_) {
    far_->readOff(readings_[static_cast<std::size_t>(passed_ - 1)], true, out);
  } else {
    (by_far_ ? static_cast<const Stepper&>(*far_) : *near_).write(out);
  }
  CompensatedSum work = work_before_;
  work.add(out[2 * dof()]);
  out[2 * dof()] = work.high;
}

double MacroStep::errorSum() const noexcept {
  return errors_before_ + (by_far_ ? far_->errorSum() : near_->errorSum());
}

void MacroStep::set(const double* q, const double* v) noexcept {
  near_->set(q, v);
  by_far_ = false;
  near_left_ = 0;
  passed_ = count_;
  work_before_ = {};
  errors_before_ = 0.0;
}

void MacroStep::exchange(StateImage& image) noexcept {
  far_->exchange(image);
  near_->exchange(image);
  image(by_far_, near_left_, passed_, piece_, work_before_, errors_before_);
  image.requireWithin(passed_, by_far_ ? 1 : 0, count_);
  image.requireWithin(near_left_, 0, kPause * count_);
}

}  // namespace whirl_twin
