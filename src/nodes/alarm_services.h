// What people tell the monitor about its alarms: the services ~acknowledge, ~reset_alarms and
// ~inhibit, and AlarmCommand by topic and by LCM. What cannot be meant is refused, and counted.
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
  /// Advertises under `own`, the node itself, and listens below `twin`. wall_time: the clock the
  /// monitor is told [s]; was_reset: called when the alarms were.
  AlarmServices(TwinMonitor& monitor, const ros::NodeHandle& own, ros::NodeHandle twin,
                std::function<double()> wall_time, std::function<void()> was_reset);

  /// From now on by LCM, too; says so in the log where that cannot receive.
  void listen(const std::string& lcm_url, const std::string& lcm_prefix);
  /// Takes what has arrived by LCM; to be called many times a second.
  void receive();

  /// Commands by topic and LCM; a service tells who calls it.
  std::uint64_t taken() const { return taken_; }
  std::uint64_t refused() const;
  /// Those that came by LCM and were no messages; null where it does not listen there.
  const RefusedPayloads* refusedPayloads() const {
    return receiver_ ? &receiver_->refused() : nullptr;
  }

 private:
  template <class Event>
  ros::ServiceServer advertise(ros::NodeHandle& node, const std::string& name,
                               bool (AlarmServices::*serve)(Event&));
  // With who calls.
  bool acknowledge(ros::ServiceEvent<Acknowledge::Request, Acknowledge::Response>& call);
  bool reset(ros::ServiceEvent<std_srvs::Trigger::Request, std_srvs::Trigger::Response>& call);
  bool inhibit(ros::ServiceEvent<Inhibit::Request, Inhibit::Response>& call);
  void take(const state::AlarmCommand& command, const std::string& by);
  void refuse(const std::string& why);
  /// Carries it out; what others have to know of it is logged and kept.
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
