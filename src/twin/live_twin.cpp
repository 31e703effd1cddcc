#include "twin/live_twin.h"

#include <algorithm>

#include "realtime/monotonic_clock.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kMaxStay = 50'000'000;  // [ns], per cycle, bounds the delay of commands

/// End [ns] of stepping as fast as possible, and of waiting: the rest of a period is for other
/// processes.
std::int64_t endOfCycle(std::int64_t scheduled, std::int64_t period) noexcept {
  return scheduled + std::min(period / 10 * 8, kMaxStay);
}

}  // namespace

LiveTwin::LiveTwin(const Scene& scene, std::size_t ring_capacity)
    : twin_(scene),
      generations_(std::make_shared<SystemGenerations>(twin_)),
      ring_(twin_.layout().size, ring_capacity),
      record_(twin_.layout().size),
      times_(twin_.timedParts(), scene.step) {
  twin_.buildEnsembles();
}

LiveTwin::~LiveTwin() {
  TwinCommand command;
  while (commands_.pop(command)) {  // not executed before the loop ended
    delete command.replacement;
    delete command.law;
  }
}

bool LiveTwin::cycle(std::int64_t scheduled) noexcept {
  times_.beginCycle();
  const bool more = resume(scheduled);
  times_.endCycle(scheduled);
  return more;
}

bool LiveTwin::resume(std::int64_t scheduled) noexcept {
  carryOutCommands();
  if (at_start_) {
    asked_ = scheduled;
    if (gate_.letsStart(twin_.stepCount())) {
      at_start_ = false;
      publish(scheduled);
    }
    return true;
  }
  if (holds()) {
    asked_ = scheduled;  // a pause does not count as waiting
    return true;
  }
  if (steps_to_do_ > 0 || pace_.factor() == Pace::kAsFastAsItGoes) {
    stepWhileThereIsTime(scheduled);
    return true;
  }
  const std::int64_t end = endOfCycle(scheduled, twin_.scene().step);
  const std::int64_t due = pace_.due();
  for (std::int64_t i = 0; i < due; ++i) {
    if (i > 0) {
      carryOutCommands();
      if (holds() || at_start_) {
        break;
      }
    }
    if (!mayStep(scheduled, end)) {
      break;
    }
    step(scheduled + i * twin_.scene().step / due, due > 1);
  }
  return true;
}

void LiveTwin::carryOutCommands() noexcept {
  if (pause_asked_.load(std::memory_order_relaxed)) {
    pauseNow();
  }
  TwinCommand command;
  while (steps_to_do_ == 0 && commands_.pop(command)) {
    carryOut(command);
  }
}

void LiveTwin::pauseNow() noexcept {
  paused_.store(true, std::memory_order_relaxed);
  if (steps_to_do_ > 0) {
    steps_to_do_ = 0;
    finish(false, 0.0);
  }
  pause_asked_.store(false, std::memory_order_release);
}

bool LiveTwin::holds() const noexcept {
  return paused_.load(std::memory_order_relaxed) && steps_to_do_ == 0;
}

bool LiveTwin::mayStep(std::int64_t now, std::int64_t end) noexcept {
  if (!gate_.isOpen() && !(hasRoom() && gate_.waitFor(twin_.stepCount() + 1, end))) {
    asked_ = now;  // no controller is asked
    return false;
  }
  const std::int64_t elapsed = now - asked_;
  asked_ = now;
  return twin_.mayStep(elapsed);
}

void LiveTwin::step(std::int64_t scheduled, bool several) noexcept {
  if (times_.isDue(several)) {
    twin_.step(times_);
  } else {
    twin_.step();
  }
  step_.store(twin_.stepCount(), std::memory_order_relaxed);
  publish(scheduled);
  if (steps_to_do_ > 0 && --steps_to_do_ == 0) {
    finish(true, 0.0);
  }
}

void LiveTwin::stepWhileThereIsTime(std::int64_t scheduled) noexcept {
  const std::int64_t end = endOfCycle(scheduled, twin_.scene().step);
  std::int64_t now = scheduled;
  const auto goesOn = [&] {
    return now < end && !at_start_ && !holds() &&
           (steps_to_do_ > 0 || pace_.factor() == Pace::kAsFastAsItGoes);
  };
  do {
    if (!hasRoom() || !mayStep(now, end)) {
      return;
    }
    step(now, true);
    carryOutCommands();
    now = monotonicNow();
  } while (goesOn());
}

void LiveTwin::carryOut(const TwinCommand& command) noexcept {
  switch (command.kind) {
    case TwinCommand::Kind::kResume:
      paused_.store(false, std::memory_order_relaxed);
      return finish(true, 0.0);
    case TwinCommand::Kind::kReset:
      if (twin_.stepCount() > 0) {
        gate_.beginRun();
      }
      twin_.reset();
      resets_.fetch_add(1, std::memory_order_relaxed);  // before the first record after the reset
      at_start_ = true;
      return finish(true, 0.0);
    case TwinCommand::Kind::kStep:
      if (!paused_.load(std::memory_order_relaxed)) {
        return finish(false, 0.0);
      }
      steps_to_do_ = command.steps;
      if (steps_to_do_ == 0) {
        finish(true, 0.0);
      }
      return;
    case TwinCommand::Kind::kLook:
      return look(command.drive);
    case TwinCommand::Kind::kReplace:
      return replaceNow(command);
    case TwinCommand::Kind::kReplaceLaw:
      return replaceLawNow(command);
    case TwinCommand::Kind::kSave:
      return save(*command.image);
    case TwinCommand::Kind::kSetInput:
      return finish(twin_.setInput(command.system, command.input, command.value, command.duration),
                    0.0);
    case TwinCommand::Kind::kSetSpeed:
      const bool accepted =
          twin_.setSpeed(command.drive, command.speed, command.max_acceleration, command.max_jerk);
      return finish(accepted, accepted ? twin_.drive(command.drive).moveDuration() : 0.0);
  }
}

void LiveTwin::look(std::size_t drive) noexcept {
  if (drive >= twin_.driveCount()) {
    return finish(false, 0.0);
  }
  const ShaftMotion motion = twin_.drive(drive).at(0.0);
  answer_.speed = motion.speed;
  answer_.acceleration = motion.acceleration;
  answer_.target_speed = twin_.drive(drive).targetSpeed();
  finish(true, 0.0);
}

void LiveTwin::replaceNow(const TwinCommand& command) noexcept {
  retired_ = twin_.replace(command.system, std::unique_ptr<Stepper>(command.replacement),
                           command.generation);
  tellChange();
}

void LiveTwin::replaceLawNow(const TwinCommand& command) noexcept {
  retired_law_ = twin_.replaceLaw(command.controller, std::unique_ptr<Controller>(command.law),
                                  command.generation);
  tellChange();
}

/// Also publishes a record, for readers that keep a state: it marks theirs at this step. Not
/// possible while the step after a reset has not been published.
void LiveTwin::save(StateImage& image) noexcept {
  if (at_start_) {
    return finish(false, 0.0);
  }
  twin_.exchange(image);
  const std::int64_t scheduled = RecordLayout::scheduled(record_.data());
  RecordLayout::setScheduled(record_.data(), RecordLayout::kSaved);
  const bool pushed = image.sound() && ring_.push(record_.data());
  RecordLayout::setScheduled(record_.data(), scheduled);
  finish(pushed, 0.0);
}

/// Publishes a change at its step, also during a pause.
void LiveTwin::tellChange() noexcept {
  if (!at_start_) {
    publish(RecordLayout::scheduled(record_.data()));
  }
  finish(true, 0.0);
}

void LiveTwin::finish(bool done, double duration) noexcept {
  answer_.done = done;
  answer_.step = twin_.stepCount();
  answer_.duration = duration;
  step_.store(answer_.step, std::memory_order_relaxed);
  carried_out_.fetch_add(1, std::memory_order_release);
}

void LiveTwin::publish(std::int64_t scheduled) noexcept {
  twin_.write(record_.data());
  RecordLayout::setScheduled(record_.data(), scheduled);
  ring_.push(record_.data());
}

void LiveTwin::restore(bool paused) noexcept {
  step_.store(twin_.stepCount(), std::memory_order_relaxed);
  paused_.store(paused, std::memory_order_relaxed);
}

bool LiveTwin::send(const TwinCommand& command) {
  if (!commands_.push(command)) {
    return false;
  }
  ++sent_;
  return true;
}

bool LiveTwin::replace(std::size_t system, std::unique_ptr<Stepper>& next,
                       std::int64_t generation) {
  if (carriedOut() < sent()) {
    return false;
  }
  retired_.reset();
  TwinCommand command;
  command.kind = TwinCommand::Kind::kReplace;
  command.system = system;
  command.replacement = next.get();
  command.generation = generation;
  if (!send(command)) {
    return false;
  }
  static_cast<void>(next.release());  // owned by the loop now
  return true;
}

bool LiveTwin::replaceLaw(std::size_t controller, std::unique_ptr<Controller>& next,
                          std::int64_t generation) {
  if (carriedOut() < sent()) {
    return false;
  }
  retired_law_.reset();
  TwinCommand command;
  command.kind = TwinCommand::Kind::kReplaceLaw;
  command.controller = controller;
  command.law = next.get();
  command.generation = generation;
  if (!send(command)) {
    return false;
  }
  static_cast<void>(next.release());  // owned by the loop now
  return true;
}

}  // namespace whirl_twin
