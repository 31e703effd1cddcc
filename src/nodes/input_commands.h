// Commands to inputs, by ROS topic <system>/inputs and by LCM: each is passed to the loop for its
// next step; invalid commands are rejected and counted.
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "messages/commands.h"
#include "nodes/twin_services.h"
#include "transport/lcm_receiver.h"
#include "twin/live_twin.h"
#include "whirl_twin/InputCommand.h"

namespace whirl_twin {

class InputCommands {
 public:
  /// Subscribes for every system with an input that the scene specifies as a number. On ROS only,
  /// without LCM or if LCM cannot receive.
  InputCommands(const LiveTwin& twin, TwinServices& services, ros::NodeHandle node,
                const std::string& lcm_url, const std::string& lcm_prefix);

  /// Whether there are subscriptions.
  bool any() const { return !subscribers_.empty(); }
  /// Handles the commands received by LCM; to be called every few milliseconds.
  void receive();

  std::uint64_t taken() const { return taken_; }
  std::uint64_t refused() const;
  /// Malformed payloads received by LCM; null without an LCM subscription.
  const RefusedPayloads* refusedPayloads() const {
    return receiver_ ? &receiver_->refused() : nullptr;
  }

 private:
  void takeMessage(const ros::MessageEvent<const InputCommand>& event, const std::string& system);
  void take(const state::InputCommand& command, const std::string& by);
  void refuse(const std::string& why);

  TwinServices& services_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<LcmReceiver> receiver_;
  std::uint64_t taken_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace whirl_twin
