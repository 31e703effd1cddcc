// The services of the simulation node: each passes a command to the loop and answers when it is
// done. ~pause has a separate thread, and interrupts a ~step in progress.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/SetInput.h>
#include <whirl_twin/SetParameter.h>
#include <whirl_twin/SetRealTimeFactor.h>
#include <whirl_twin/SetSpeed.h>
#include <whirl_twin/StepN.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "messages/commands.h"
#include "twin/checkpoint.h"
#include "twin/live_parameters.h"
#include "twin/live_twin.h"

namespace whirl_twin {

/// Why a real-time factor is invalid; "" if it is valid.
std::string factorFault(double factor);

class TwinServices {
 public:
  /// Advertises under `node`. A service waits for its command while keep_waiting() is true, which
  /// is called from any thread.
  TwinServices(LiveTwin& twin, ros::NodeHandle node, std::function<bool()> keep_waiting);

  /// Whether ramped parameter changes are in progress: continueRamps() must then be called every
  /// few milliseconds.
  bool ramping() const { return parameters_.ramping(); }
  void continueRamps();

  // Checkpoints (twin/checkpoint.h).

  /// Not during a call of a service.
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

  /// Passes on a command received by topic or channel. Returns why it is rejected; "" if it was
  /// accepted.
  std::string take(const state::InputCommand& command, const std::string& by);
  /// Inputs that a command overrides at present: which, by whom, since when and until when; "" if
  /// none. Their effect on a twin may mask the behaviour of its machine.
  std::string heldInputs() const;

 private:
  using Trigger = std_srvs::Trigger;
  bool pause(Trigger::Request&, Trigger::Response& response);
  bool resume(Trigger::Request&, Trigger::Response& response);
  bool reset(Trigger::Request&, Trigger::Response& response);
  bool step(StepN::Request& request, StepN::Response& response);
  bool setSpeed(SetSpeed::Request& request, SetSpeed::Response& response);
  bool setInput(ros::ServiceEvent<SetInput::Request, SetInput::Response>& call);
  void noteInput(const std::string& system, const std::string& input, double value, double duration,
                 const std::string& by);
  /// Fills the command that sets an input to a value for a duration [s]; returns the error, or "".
  std::string readInput(const std::string& system, const std::string& input, double value,
                        double duration, TwinCommand& command) const;
  bool setParameter(SetParameter::Request& request, SetParameter::Response& response);
  bool setRealTimeFactor(SetRealTimeFactor::Request& request,
                         SetRealTimeFactor::Response& response);

  bool trigger(TwinCommand::Kind kind, const char* done, Trigger::Response& response);
  void advertisePause(ros::NodeHandle node);
  /// Waits until all commands sent are executed; false if the loop ended first.
  bool wait();
  bool stepPastUpdates(std::uint64_t steps, TwinAnswer& answer);
  /// Sends a command and waits; false if the loop ended first or accepts no commands.
  bool carryOut(const TwinCommand& command, TwinAnswer& answer);

  LiveTwin& twin_;
  std::function<bool()> keep_waiting_;
  LiveParameters parameters_;
  struct HeldInput {
    std::string text;
    std::int64_t since, until;  // steps
  };
  std::map<std::string, HeldInput> held_inputs_;
  std::atomic<std::uint64_t> pauses_{0};  // number of requests
  // A separate queue, so that ~pause does not wait for a long service.
  ros::CallbackQueue pause_queue_;
  ros::AsyncSpinner pause_thread_{1, &pause_queue_};
  std::vector<ros::ServiceServer> servers_;  // last: destroyed before pause_queue_
};

}  // namespace whirl_twin
