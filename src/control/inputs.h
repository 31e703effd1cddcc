// Inputs of one system during a step, in the order of its model. The twin owns them, like drives,
// and steps refer to them.
//
// A step reads them piece by piece. A piece ends at the next breakpoint: a jump of a
// piecewise-constant table or a kink of a linear one. Within a piece an input is linear in time or
// harmonic, so that the side of a jump is always defined. A command takes effect at a begin(), so
// that a constant is the same over a whole step.
//
// The output of a controller changes at its sample instants, inside steps too: the twin then
// divides a step into sub-steps between these instants (Stepper::stepPart). Behind a lag the input
// decays towards it as e^(-t / lag) between instants, evaluated in closed form from the value at
// the last instant and the time since, so that no step adds to its error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "control/input_signal.h"
#include "control/shaft_angle.h"
#include "realtime/state_image.h"

namespace whirl_twin {

class Inputs {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  // Not real-time safe.

  Inputs() = default;
  /// One signal for each input of a model. Throws std::logic_error for one with a fault.
  explicit Inputs(const std::vector<InputSignal>& signals);

  /// Steps must be divided into sub-steps. Their lengths [ns] are these, or sums of them.
  void setParts(std::vector<std::int64_t> lengths) { parts_ = std::move(lengths); }
  /// Longest first; empty: steps are not divided.
  const std::vector<std::int64_t>& parts() const { return parts_; }

  std::size_t count() const noexcept { return channels_.size(); }
  const InputSignal& signal(std::size_t input) const { return channels_[input].signal; }
  bool acts(std::size_t input) const {
    return channels_[input].signal.kind != InputSignal::Kind::kNone;
  }
  /// Whether any input acts or steps are divided.
  bool any() const;
  /// Whether it may have breakpoints.
  bool isTable(std::size_t input) const {
    return channels_[input].signal.kind == InputSignal::Kind::kTable;
  }
  bool isHarmonic(std::size_t input) const {
    return channels_[input].signal.kind == InputSignal::Kind::kHarmonic;
  }

  // Real-time safe: no allocation, no lock, no exception.

  /// Starts the step at this simulated time [ns]; times may go back, too.
  void begin(std::int64_t time) noexcept;
  /// Discards all commands.
  void reset() noexcept;
  void exchange(StateImage& image) noexcept { image(channels_, time_); }

  /// From the next begin() on, a constant has this value until the simulated time `until` [ns],
  /// then its configured value again. False, with nothing changed, for a value that is not finite,
  /// for an unknown input, and for one that is a harmonic, a table or inactive.
  bool set(std::size_t input, double value, std::int64_t until) noexcept;
  /// The output of a controller, or the target of its actuator, from simulated time `time` [ns] on.
  void control(std::size_t input, double value, std::int64_t time) noexcept {
    Channel& channel = channels_[input];
    if (channel.signal.pole > 0.0) {
      channel.lagging = lagging(channel, time);
      channel.since = time;
    }
    channel.held = value;
  }
  /// Sets the output and its lagged value to zero.
  void release(std::size_t input) noexcept {
    channels_[input].held = channels_[input].lagging = 0.0;
    channels_[input].since = time_;
  }
  /// [ns], of the last begin().
  std::int64_t begun() const noexcept { return time_; }
  /// [1/s], rate of the first-order lag behind the held value; 0: no lag.
  double pole(std::size_t input) const noexcept { return channels_[input].signal.pole; }
  /// Whether a command is active.
  bool commanded(std::size_t input) const noexcept {
    return channels_[input].command_until > time_;
  }

  /// The first breakpoint of any input later than an offset [ns] after begin(), as such an offset.
  std::int64_t nextCorner(std::int64_t offset) const noexcept {
    return tables_ == 0 ? kNever : cornerAfter(offset);
  }
  /// A non-harmonic input from an offset [ns] after begin() to the next breakpoint; a breakpoint at
  /// the offset itself has been passed.
  SignalPiece piece(std::size_t input, std::int64_t offset) const noexcept;
  /// The argument [rad] of a harmonic's cosine at begin(), less whole turns.
  double phase(std::size_t input) const noexcept { return channels_[input].phase; }
  /// At an offset [s] after begin().
  double value(std::size_t input, double offset) const noexcept;

 private:
  struct Channel {
    InputSignal signal;
    SteadyTurn turn;  // of a harmonic, from simulated time 0
    double held = 0.0;
    double lagging = 0.0;    // behind it, at the instant
    std::int64_t since = 0;  // [ns]
    double command = 0.0;
    std::int64_t command_until = std::numeric_limits<std::int64_t>::min();
    // At begin().
    double phase = 0.0;
    std::size_t passed = 0;  // of a table: how many of its instants

    void exchange(StateImage& image) noexcept {
      image(held, lagging, since, command, command_until, phase, passed);
      image.requireWithin(passed, std::size_t{0}, signal.instants.size());
    }
  };
  std::int64_t cornerAfter(std::int64_t offset) const noexcept;
  static double lagging(const Channel& channel, std::int64_t time) noexcept;
  static std::size_t passedAt(const Channel& channel, std::int64_t time) noexcept;

  std::vector<Channel> channels_;
  std::vector<std::int64_t> parts_;
  std::size_t tables_ = 0;
  std::int64_t time_ = 0;
};

}  // namespace whirl_twin
