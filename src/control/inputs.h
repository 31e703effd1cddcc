// The inputs of one system while it steps, in the order in which its model names them. The twin
// owns them as it owns drives, and steps refer to them.
//
// A step reads them piece by piece. A piece ends at the next corner: where a held table jumps or a
// linear one kinks. Within a piece an input is a straight line in time or a harmonic, and no step
// has to guess on which side of a jump it stands. A command takes effect at a begin(), so that a
// constant is the same over a whole step.
//
// What a controller acts with changes at its instants, inside steps too: the twin then takes a step
// in parts from instant to instant (Stepper::stepPart). Behind a lag it goes on from instant to
// instant as e^(-t / lag): what it was at the last instant and the time since are all that it is,
// so that no step adds to its error.
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

  /// Steps are to be taken in parts. Their lengths [ns] are these, or sums of them.
  void setParts(std::vector<std::int64_t> lengths) { parts_ = std::move(lengths); }
  /// Longest first; empty: steps are taken whole.
  const std::vector<std::int64_t>& parts() const { return parts_; }

  std::size_t count() const noexcept { return channels_.size(); }
  const InputSignal& signal(std::size_t input) const { return channels_[input].signal; }
  bool acts(std::size_t input) const {
    return channels_[input].signal.kind != InputSignal::Kind::kNone;
  }
  /// Does any input act, or are steps taken in parts?
  bool any() const;
  /// May it have corners?
  bool isTable(std::size_t input) const {
    return channels_[input].signal.kind == InputSignal::Kind::kTable;
  }
  bool isHarmonic(std::size_t input) const {
    return channels_[input].signal.kind == InputSignal::Kind::kHarmonic;
  }

  // Real-time safe: no allocation, no lock, no exception.

  /// Starts the step at this simulated time [ns]; times may go back, too.
  void begin(std::int64_t time) noexcept;
  /// Forgets all commands.
  void reset() noexcept;
  void exchange(StateImage& image) noexcept { image(channels_, time_); }

  /// From the next begin() on, a constant has this value until the simulated time `until` [ns],
  /// then its own again. False, with nothing changed, for a value that is not finite, for an input
  /// that there is not, and for one that is a harmonic, a table or does not act.
  bool set(std::size_t input, double value, std::int64_t until) noexcept;
  /// What a controller acts with, or has its actuator follow, from simulated time `time` [ns] on.
  void control(std::size_t input, double value, std::int64_t time) noexcept {
    Channel& channel = channels_[input];
    if (channel.signal.pole > 0.0) {
      channel.lagging = lagging(channel, time);
      channel.since = time;
    }
    channel.held = value;
  }
  /// It acts with nothing, and has done so before.
  void release(std::size_t input) noexcept {
    channels_[input].held = channels_[input].lagging = 0.0;
    channels_[input].since = time_;
  }
  /// [ns], of the last begin().
  std::int64_t begun() const noexcept { return time_; }
  /// [1/s], at which it follows what it is held at; 0: at once.
  double pole(std::size_t input) const noexcept { return channels_[input].signal.pole; }
  /// Has a command that still holds.
  bool commanded(std::size_t input) const noexcept {
    return channels_[input].command_until > time_;
  }

  /// The first corner of any input later than an offset [ns] after begin(), as such an offset.
  std::int64_t nextCorner(std::int64_t offset) const noexcept {
    return tables_ == 0 ? kNever : cornerAfter(offset);
  }
  /// An input that is no harmonic from an offset [ns] after begin() to the next corner; a corner
  /// there has been passed.
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
