// The services of the simulation node: each hands a command to the loop and answers when it is
// done.
#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/SetSpeed.h>
#include <whirl_twin/StepN.h>

#include <functional>

#include "scene/live_twin.h"

namespace whirl_twin {

class TwinServices {
 public:
  /// Advertises under `node`. A service waits for its command as long as keep_waiting() is true.
  TwinServices(LiveTwin& twin, ros::NodeHandle node, std::function<bool()> keep_waiting);

 private:
  using Trigger = std_srvs::Trigger;
  bool pause(Trigger::Request&, Trigger::Response& response);
  bool resume(Trigger::Request&, Trigger::Response& response);
  bool reset(Trigger::Request&, Trigger::Response& response);
  bool step(StepN::Request& request, StepN::Response& response);
  bool setSpeed(SetSpeed::Request& request, SetSpeed::Response& response);

  bool trigger(TwinCommand::Kind kind, const char* done, Trigger::Response& response);
  /// Sends and waits; false when the loop ended first or takes no commands.
  bool carryOut(const TwinCommand& command, TwinAnswer& answer);

  LiveTwin& twin_;
  std::function<bool()> keep_waiting_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace whirl_twin
