// Commands to a twin that runs: pause, resume, reset, step, and changes of speeds, inputs and
// parameters. Each is checked, passed to the loop, and answered when it is done. Services of ROS
// and the web server use them, so that both have the same checks and messages.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "control/speed_profile.h"
#include "messages/commands.h"
#include "twin/checkpoint.h"
#include "twin/live_parameters.h"
#include "twin/live_twin.h"

namespace whirl_twin {

/// Why a real-time factor is invalid; "" if it is valid.
std::string factorFault(double factor);

struct CommandResult {
  bool done = false;
  std::string message;    ///< what was done, or why it was not
  std::int64_t step = 0;  ///< current step
  double duration = 0.0;  ///< [s], of a move of a drive
  double speed = 0.0;     ///< [rad/s], its final speed; NaN: the move is not possible
  double previous = 0.0;  ///< value of the first parameter before; NaN: not changed
};

class LiveCommands {
 public:
  /// Before the loop starts. A command waits while keep_waiting() is true, which is called from any
  /// thread.
  LiveCommands(LiveTwin& twin, std::function<bool()> keep_waiting);

  // Any thread.

  /// Requests a pause, which interrupts a step() in progress.
  void requestPause() noexcept;
  /// The same, and waits for it.
  CommandResult pause();

  // The thread that sends the commands.

  CommandResult resume();
  CommandResult reset();
  CommandResult step(std::uint64_t steps);
  CommandResult setSpeed(const std::string& drive, const SpeedMove& move);
  /// by: the sender, for heldInputs().
  CommandResult setInput(const std::string& system, const std::string& input, double value,
                         double duration, const std::string& by);
  CommandResult setParameter(const ParameterRequest& request);
  CommandResult setRealTimeFactor(double factor);

  /// Passes on a command without waiting for it. Returns why it is rejected; "" if it was accepted.
  std::string take(const state::InputCommand& command, const std::string& by);
  /// Inputs that a command overrides at present: which, by whom, since when and until when; "" if
  /// none. Their effect on a twin may mask the behaviour of its machine.
  std::string heldInputs() const;

  /// Whether ramped parameter changes are in progress: continueRamps() must then be called every
  /// few milliseconds.
  bool ramping() const { return parameters_.ramping(); }
  /// Returns the errors of aborted ramps.
  std::vector<std::string> continueRamps();

  // Checkpoints (twin/checkpoint.h).

  /// Not during a command.
  bool take(Checkpoint& out) {
    return takeCheckpoint(
        twin_, parameters_, [this] { return wait(); }, out);
  }
  /// After the end of the loop.
  void takeAtRest(Checkpoint& out) { whirl_twin::takeAtRest(twin_, parameters_, out); }
  /// Before the start of the loop.
  void resumeFrom(const Checkpoint& checkpoint, const std::string& source) {
    whirl_twin::resume(checkpoint, twin_, parameters_, source);
  }

 private:
  struct HeldInput {
    std::string text;
    std::int64_t since, until;  // steps
  };

  /// Waits until all commands sent are executed; false if the loop ended first.
  bool wait();
  /// Sends a command and waits; false if the loop ended first or accepts no commands.
  bool carryOut(const TwinCommand& command, TwinAnswer& answer);
  CommandResult trigger(TwinCommand::Kind kind, const char* done);
  bool stepPastUpdates(std::uint64_t steps, TwinAnswer& answer);
  std::string findDrive(const std::string& name, std::size_t& drive) const;
  /// Fills the command that sets an input to a value for a duration [s]; returns the error, or "".
  std::string readInput(const std::string& system, const std::string& input, double value,
                        double duration, TwinCommand& command) const;
  void noteInput(const std::string& system, const std::string& input, double value, double duration,
                 const std::string& by);

  LiveTwin& twin_;
  std::function<bool()> keep_waiting_;
  LiveParameters parameters_;
  std::map<std::string, HeldInput> held_inputs_;
  std::atomic<std::uint64_t> pauses_{0};  // number of requests
  std::vector<std::string> given_up_;     // ramps, during a step()
};

}  // namespace whirl_twin
