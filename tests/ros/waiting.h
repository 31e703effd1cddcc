// Waiting for the state of a live system, instead of sleeping: callbacks are served until a
// condition is true or the time-out expires.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <functional>

namespace whirl_twin {

inline bool waitUntil(const std::function<bool()>& condition, double patience = 40.0) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(patience);
  while (ros::ok() && ros::WallTime::now() < end) {
    if (condition()) {
      return true;
    }
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
  return condition();
}

}  // namespace whirl_twin
