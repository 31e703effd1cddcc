// What people tell the monitor about its alarms: ~acknowledge, ~reset_alarms, ~inhibit.
#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/Acknowledge.h>
#include <whirl_twin/Inhibit.h>

#include <functional>
#include <vector>

#include "monitoring/twin_monitor.h"

namespace whirl_twin {

class AlarmServices {
 public:
  /// Advertises under `node`. wall_time: the clock the monitor is told [s]; was_reset: called when
  /// the alarms were.
  AlarmServices(TwinMonitor& monitor, ros::NodeHandle node, std::function<double()> wall_time,
                std::function<void()> was_reset);

 private:
  bool acknowledge(Acknowledge::Request& request, Acknowledge::Response& response);
  bool reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool inhibit(Inhibit::Request& request, Inhibit::Response& response);

  TwinMonitor& monitor_;
  std::function<double()> wall_time_;
  std::function<void()> was_reset_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace whirl_twin
