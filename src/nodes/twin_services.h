// The services of the simulation node: each passes a command to the loop and answers when it is
// done (twin/live_commands.h). ~pause has a separate thread, and interrupts a ~step in progress.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/SetInput.h>
#include <whirl_twin/SetParameter.h>
#include <whirl_twin/SetRealTimeFactor.h>
#include <whirl_twin/SetSpeed.h>
#include <whirl_twin/StepN.h>

#include <functional>
#include <string>
#include <vector>

#include "messages/commands.h"
#include "twin/live_commands.h"

namespace whirl_twin {

class TwinServices {
 public:
  /// Advertises under `node`. A service waits for its command while keep_waiting() is true, which
  /// is called from any thread.
  TwinServices(LiveTwin& twin, ros::NodeHandle node, std::function<bool()> keep_waiting);

  /// Whether ramped parameter changes are in progress: continueRamps() must then be called every
  /// few milliseconds.
  bool ramping() const { return commands_.ramping(); }
  void continueRamps();

  // Checkpoints (twin/checkpoint.h).

  /// Not during a call of a service.
  bool take(Checkpoint& out) { return commands_.take(out); }
  /// After the end of the loop.
  void takeAtRest(Checkpoint& out) { commands_.takeAtRest(out); }
  /// Before the start of the loop.
  void resumeFrom(const Checkpoint& checkpoint, const std::string& source) {
    commands_.resumeFrom(checkpoint, source);
  }

  /// Passes on a command received by topic or channel. Returns why it is rejected; "" if it was
  /// accepted.
  std::string take(const state::InputCommand& command, const std::string& by) {
    return commands_.take(command, by);
  }
  /// LiveCommands::heldInputs().
  std::string heldInputs() const { return commands_.heldInputs(); }

 private:
  using Trigger = std_srvs::Trigger;
  bool pause(Trigger::Request&, Trigger::Response& response);
  bool resume(Trigger::Request&, Trigger::Response& response);
  bool reset(Trigger::Request&, Trigger::Response& response);
  bool step(StepN::Request& request, StepN::Response& response);
  bool setSpeed(SetSpeed::Request& request, SetSpeed::Response& response);
  bool setInput(ros::ServiceEvent<SetInput::Request, SetInput::Response>& call);
  bool setParameter(SetParameter::Request& request, SetParameter::Response& response);
  bool setRealTimeFactor(SetRealTimeFactor::Request& request,
                         SetRealTimeFactor::Response& response);
  void advertisePause(ros::NodeHandle node);

  LiveTwin& twin_;
  LiveCommands commands_;
  // A separate queue, so that ~pause does not wait for a long service.
  ros::CallbackQueue pause_queue_;
  ros::AsyncSpinner pause_thread_{1, &pause_queue_};
  std::vector<ros::ServiceServer> servers_;  // last: destroyed before pause_queue_
};

}  // namespace whirl_twin
