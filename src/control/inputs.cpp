#include "control/inputs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace whirl_twin {

namespace {

double seconds(std::int64_t nanoseconds) noexcept {
  return static_cast<double>(nanoseconds) / 1e9;
}

}  // namespace

Inputs::Inputs(const std::vector<InputSignal>& signals) {
  for (const InputSignal& signal : signals) {
    const SignalFault fault = faultOf(signal);
    if (fault.expected != nullptr) {
      throw std::logic_error("input " + std::to_string(channels_.size()) + ": " + fault.field +
                             " " + fault.expected);
    }
    Channel channel;
    channel.signal = signal;
    if (signal.kind == InputSignal::Kind::kHarmonic) {
      channel.turn = SteadyTurn(shaftAngle(signal.phase), signal.frequency, 0.0);
    }
    tables_ += signal.kind == InputSignal::Kind::kTable ? 1 : 0;
    channels_.push_back(channel);
  }
  begin(0);
}

bool Inputs::any() const {
  return !parts_.empty() || std::any_of(channels_.begin(), channels_.end(), [](const Channel& c) {
    return c.signal.kind != InputSignal::Kind::kNone;
  });
}

void Inputs::begin(std::int64_t time) noexcept {
  time_ = time;
  for (Channel& channel : channels_) {
    switch (channel.signal.kind) {
      case InputSignal::Kind::kHeld:
        channel.held = time < channel.command_until ? channel.command : channel.signal.value;
        break;
      case InputSignal::Kind::kHarmonic:
        channel.phase = channel.turn.at(time).remainder;
        break;
      case InputSignal::Kind::kTable:
        channel.passed = passedAt(channel, time);
        break;
      case InputSignal::Kind::kControlled:
      case InputSignal::Kind::kNone:
        break;
    }
  }
}

void Inputs::reset() noexcept {
  for (Channel& channel : channels_) {
    channel.command_until = std::numeric_limits<std::int64_t>::min();
    channel.held = 0.0;
  }
}

bool Inputs::set(std::size_t input, double value, std::int64_t until) noexcept {
  if (input >= channels_.size() || !std::isfinite(value) ||
      channels_[input].signal.kind != InputSignal::Kind::kHeld) {
    return false;
  }
  channels_[input].command = value;
  channels_[input].command_until = until;
  return true;
}

/// How many instants of a table are not later than `time`: from where it last stood, a few on.
std::size_t Inputs::passedAt(const Channel& channel, std::int64_t time) noexcept {
  const std::vector<std::int64_t>& instants = channel.signal.instants;
  std::size_t passed = channel.passed;
  if (passed > 0 && instants[passed - 1] > time) {
    passed = 0;
  }
  constexpr std::size_t kFew = 8;
  const std::size_t near = std::min(instants.size(), passed + kFew);
  while (passed < near && instants[passed] <= time) {
    ++passed;
  }
  if (passed == near) {
    const auto from = instants.begin() + static_cast<std::ptrdiff_t>(passed);
    passed += static_cast<std::size_t>(std::upper_bound(from, instants.end(), time) - from);
  }
  return passed;
}

double Inputs::lagging(const Channel& channel, std::int64_t time) noexcept {
  return channel.lagging - (channel.held - channel.lagging) *
                               std::expm1(-channel.signal.pole * seconds(time - channel.since));
}

std::int64_t Inputs::cornerAfter(std::int64_t offset) const noexcept {
  const std::int64_t time = time_ + offset;
  std::int64_t corner = kNever;
  for (const Channel& channel : channels_) {
    if (channel.signal.kind == InputSignal::Kind::kTable) {
      const std::size_t passed = passedAt(channel, time);
      if (passed < channel.signal.instants.size()) {
        corner = std::min(corner, channel.signal.instants[passed]);
      }
    }
  }
  return corner == kNever ? kNever : corner - time_;
}

SignalPiece Inputs::piece(std::size_t input, std::int64_t offset) const noexcept {
  const Channel& channel = channels_[input];
  if (channel.signal.kind != InputSignal::Kind::kTable) {
    const double pole = channel.signal.pole;
    return pole > 0.0 ? SignalPiece{seconds(channel.since - time_), channel.lagging,
                                    pole * (channel.held - channel.lagging), pole}
                      : SignalPiece{0.0, channel.held, 0.0};
  }
  const std::vector<std::int64_t>& instants = channel.signal.instants;
  const std::vector<double>& values = channel.signal.values;
  const std::size_t passed = passedAt(channel, time_ + offset);
  const std::size_t last = passed > 0 ? passed - 1 : 0;
  if (channel.signal.hold || passed == 0 || passed == instants.size()) {
    return {0.0, values[last], 0.0};
  }
  const double duration = seconds(instants[passed] - instants[last]);
  const double slope = (values[passed] - values[last]) / duration;
  if (instants[last] >= time_) {
    return {seconds(instants[last] - time_), values[last], slope};
  }
  const double share = seconds(time_ - instants[last]) / duration;
  return {0.0, values[last] + share * (values[passed] - values[last]), slope};
}

double Inputs::value(std::size_t input, double offset) const noexcept {
  const InputSignal& signal = channels_[input].signal;
  if (signal.kind == InputSignal::Kind::kHarmonic) {
    return signal.amplitude * std::cos(channels_[input].phase + signal.frequency * offset);
  }
  return piece(input, static_cast<std::int64_t>(std::floor(offset * 1e9 + 1e-3))).at(offset);
}

}  // namespace whirl_twin
