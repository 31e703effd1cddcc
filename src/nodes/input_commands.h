// Commands to inputs as they come in, by ROS topic <system>/inputs and by LCM: each goes to the
// loop for its next step; what cannot be meant is refused and counted.
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
  /// Listens for every system that has an input which the scene gives as a number; where there is
  /// none, not at all. Without LCM, or where that cannot receive, on ROS alone.
  InputCommands(const LiveTwin& twin, TwinServices& services, ros::NodeHandle node,
                const std::string& lcm_url, const std::string& lcm_prefix);

  /// Something may come in.
  bool any() const { return !subscribers_.empty(); }
  /// Takes what has arrived by LCM; to be called every few milliseconds.
  void receive();

  std::uint64_t taken() const { return taken_; }
  std::uint64_t refused() const;
  /// Those that came by LCM and were no messages; null where it does not listen there.
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
