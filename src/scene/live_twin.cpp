#include "scene/live_twin.h"

namespace whirl_twin {

LiveTwin::LiveTwin(const Scene& scene, std::size_t ring_capacity)
    : twin_(scene), ring_(twin_.layout().size, ring_capacity), record_(twin_.layout().size) {}

bool LiveTwin::cycle(std::int64_t scheduled) noexcept {
  TwinCommand command;
  while (steps_to_do_ == 0 && commands_.pop(command)) {
    carryOut(command);
  }
  if (at_start_) {
    at_start_ = false;
    publish(scheduled);
    return true;
  }
  if (paused_.load(std::memory_order_relaxed) && steps_to_do_ == 0) {
    return true;
  }
  twin_.step();
  publish(scheduled);
  if (steps_to_do_ > 0 && --steps_to_do_ == 0) {
    finish(true, 0.0);
  }
  return true;
}

void LiveTwin::carryOut(const TwinCommand& command) noexcept {
  switch (command.kind) {
    case TwinCommand::Kind::kPause:
      paused_.store(true, std::memory_order_relaxed);
      return finish(true, 0.0);
    case TwinCommand::Kind::kResume:
      paused_.store(false, std::memory_order_relaxed);
      return finish(true, 0.0);
    case TwinCommand::Kind::kReset:
      twin_.reset();
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
    case TwinCommand::Kind::kSetSpeed:
      const bool accepted =
          twin_.setSpeed(command.drive, command.speed, command.max_acceleration, command.max_jerk);
      return finish(accepted, accepted ? twin_.drive(command.drive).moveDuration() : 0.0);
  }
}

void LiveTwin::finish(bool done, double duration) noexcept {
  answer_ = {done, twin_.stepCount(), duration};
  carried_out_.fetch_add(1, std::memory_order_release);
}

void LiveTwin::publish(std::int64_t scheduled) noexcept {
  twin_.write(record_.data());
  record_[RecordLayout::kScheduled] = packed(scheduled);
  ring_.push(record_.data());
}

bool LiveTwin::send(const TwinCommand& command) {
  if (!commands_.push(command)) {
    return false;
  }
  ++sent_;
  return true;
}

}  // namespace whirl_twin
