#include "transport/ros_converters.h"

#include <algorithm>

namespace whirl_twin {

ros::Time toRosTime(std::int64_t stamp) {
  constexpr std::int64_t kSecond = 1000000000;
  const std::int64_t within = std::clamp<std::int64_t>(stamp, 0, kMaxStamp);
  return {static_cast<std::uint32_t>(within / kSecond),
          static_cast<std::uint32_t>(within % kSecond)};
}

AlertArray toRos(const std::vector<state::Alert>& alerts, std::int64_t stamp) {
  AlertArray message;
  message.header.stamp = toRosTime(stamp);
  for (const auto& alert : alerts) {
    message.alerts.push_back(toRos(alert));
  }
  return message;
}

std::vector<state::Alert> fromRos(const AlertArray& message) {
  std::vector<state::Alert> alerts;
  for (const auto& alert : message.alerts) {
    alerts.push_back(fromRos(alert));
    alerts.back().stamp = static_cast<std::int64_t>(message.header.stamp.toNSec());
  }
  return alerts;
}

sensor_msgs::JointState toJointState(const state::WhirlState& whirl) {
  sensor_msgs::JointState message;
  message.header.stamp = toRosTime(whirl.at.stamp);
  message.header.frame_id = whirl.system;
  message.name = {"x", "y"};
  message.position = {whirl.x, whirl.y};
  message.velocity = {whirl.x_rate, whirl.y_rate};
  return message;
}

sensor_msgs::JointState toJointState(const state::PendulumState& pendulum) {
  sensor_msgs::JointState message;
  message.header.stamp = toRosTime(pendulum.at.stamp);
  message.header.frame_id = pendulum.system;
  message.name = pendulum.name;
  message.position = pendulum.angle;
  message.velocity = pendulum.rate;
  return message;
}

}  // namespace whirl_twin
