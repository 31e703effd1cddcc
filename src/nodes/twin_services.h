// The services of the simulation node: each hands a command to the loop and answers when it is
// done. ~pause has a thread of its own, and ends a ~step that is under way.
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

/// Why a real-time factor cannot be taken; "" if it can.
std::string factorFault(double factor);

class TwinServices {
 public:
  /// Advertises under `node`. A service waits for its command as long as keep_waiting() is true,
  /// which any thread may ask.
  TwinServices(LiveTwin& twin, ros::NodeHandle node, std::function<bool()> keep_waiting);

  /// Changes of parameters that go in a ramp are under way: continueRamps() is to be called every
  /// few milliseconds.
  bool ramping() const { return parameters_.ramping(); }
  void continueRamps();

  // Of checkpoints (twin/checkpoint.h).

  /// Between two calls of services.
  bool take(Checkpoint& out) {
    return takeCheckpoint(
        twin_, parameters_, [this] { return wait(); }, out);
  }
  /// The loop has ended.
  void takeAtRest(Checkpoint& out) { whirl_twin::takeAtRest(twin_, parameters_, out); }
  /// The loop is yet to begin.
  void goOnFrom(const Checkpoint& checkpoint, const std::string& source) {
    whirl_twin::resume(checkpoint, twin_, parameters_, source);
  }

  /// A command that came by topic or channel. Returns why it is refused; "" if it is on its way.
  std::string take(const state::InputCommand& command, const std::string& by);
  /// Inputs that are not the scene's at present: which, by whom, since when and until when; "": all
  /// are. What they do to a twin may hide what its machine would do.
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
  /// Fills the command that sets an input to a value for a duration [s]; what is wrong, or "".
  std::string readInput(const std::string& system, const std::string& input, double value,
                        double duration, TwinCommand& command) const;
  bool setParameter(SetParameter::Request& request, SetParameter::Response& response);
  bool setRealTimeFactor(SetRealTimeFactor::Request& request,
                         SetRealTimeFactor::Response& response);

  bool trigger(TwinCommand::Kind kind, const char* done, Trigger::Response& response);
  void advertisePause(ros::NodeHandle node);
  /// Until all that was sent is carried out; false when the loop ended first.
  bool wait();
  bool stepPastUpdates(std::uint64_t steps, TwinAnswer& answer);
  /// Sends and waits; false when the loop ended first or takes no commands.
  bool carryOut(const TwinCommand& command, TwinAnswer& answer);

  LiveTwin& twin_;
  std::function<bool()> keep_waiting_;
  LiveParameters parameters_;
  struct HeldInput {
    std::string text;
    std::int64_t since, until;  // steps
  };
  std::map<std::string, HeldInput> held_inputs_;
  std::atomic<std::uint64_t> pauses_{0};  // asked for
  // ~pause is not kept waiting by a service that takes long.
  ros::CallbackQueue pause_queue_;
  ros::AsyncSpinner pause_thread_{1, &pause_queue_};
  std::vector<ros::ServiceServer> servers_;  // gone before the queue that one of them has
};

}  // namespace whirl_twin
