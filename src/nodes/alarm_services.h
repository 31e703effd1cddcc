// Operator commands to the alarms of the monitor: the services ~acknowledge, ~reset_alarms and
// ~inhibit, and AlarmCommand by topic and by LCM. Invalid commands are rejected and counted.
#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/Acknowledge.h>
#include <whirl_twin/AlarmCommand.h>
#include <whirl_twin/Inhibit.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "monitoring/alarm_commands.h"
#include "transport/lcm_receiver.h"

namespace whirl_twin {

class AlarmServices {
 public:
  /// Advertises under `own`, the node itself, and subscribes below `twin`. wall_time: the clock of
  /// the monitor [s]; was_reset: called after a reset of the alarms.
  AlarmServices(TwinMonitor& monitor, const ros::NodeHandle& own, ros::NodeHandle twin,
                std::function<double()> wall_time, std::function<void()> was_reset);

  /// Also subscribes by LCM; logs a warning if LCM cannot receive.
  void listen(const std::string& lcm_url, const std::string& lcm_prefix);
  /// Handles the commands received by LCM; to be called many times a second.
  void receive();

  /// Commands by topic and LCM; those by service are answered to the caller and not counted.
  std::uint64_t taken() const { return taken_; }
  std::uint64_t refused() const;
  /// Malformed payloads received by LCM; null without an LCM subscription.
  const RefusedPayloads* refusedPayloads() const {
    return receiver_ ? &receiver_->refused() : nullptr;
  }

 private:
  template <class Event>
  ros::ServiceServer advertise(ros::NodeHandle& node, const std::string& name,
                               bool (AlarmServices::*serve)(Event&));
  // Service events, for the name of the caller.
  bool acknowledge(ros::ServiceEvent<Acknowledge::Request, Acknowledge::Response>& call);
  bool reset(ros::ServiceEvent<std_srvs::Trigger::Request, std_srvs::Trigger::Response>& call);
  bool inhibit(ros::ServiceEvent<Inhibit::Request, Inhibit::Response>& call);
  void take(const state::AlarmCommand& command, const std::string& by);
  void refuse(const std::string& why);
  /// Executes a command, and records it in the log and the history if operators need it.
  CommandAnswer answer(const state::AlarmCommand& command, const std::string& by);

  TwinMonitor& monitor_;
  std::function<double()> wall_time_;
  std::function<void()> was_reset_;
  std::vector<ros::ServiceServer> servers_;
  ros::Subscriber subscriber_;
  std::unique_ptr<LcmReceiver> receiver_;
  std::uint64_t taken_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace whirl_twin
