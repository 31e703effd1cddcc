#include "nodes/alert_events.h"

#include <ros/ros.h>

namespace whirl_twin {

namespace {

constexpr double kPeriod = 5.0;  // s

}  // namespace

void AlertEvents::tell(const state::Alert& event) {
  lcm_.publish(event);
  newest_ = event.time;
  if (!event.raised || event.latched) {
    ROS_INFO("%s: %s %s: %s", event.system.c_str(), event.type.c_str(),
             event.latched ? "latched" : "cleared", event.text.c_str());
  } else if (event.acknowledged) {
    ROS_INFO("%s: %s acknowledged", event.system.c_str(), event.type.c_str());
  } else {
    ROS_WARN("%s", event.text.c_str());
  }
}

void AlertEvents::tellAgain(const std::vector<state::Alert>& active, double now) {
  if (!lcm_.on() || now < next_) {
    return;
  }
  next_ = now + kPeriod;
  for (state::Alert alert : active) {
    alert.time = newest_;  // an older one would be of a run that has begun anew
    lcm_.publish(alert);
  }
}

}  // namespace whirl_twin
