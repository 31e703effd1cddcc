// A message of a rosbag -> one of the twin's, with nothing taken on trust. ROS's generated types
// are not needed: fields are found by their names in the definition that the bag has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "transport/bag_scan.h"
#include "transport/channels.h"
#include "transport/ros_layout.h"

namespace whirl_twin {

/// The messages of a connection of a bag.
class BagDecoder {
 public:
  /// Throws RejectedMessage for a definition that cannot be read.
  explicit BagDecoder(const BagConnection& connection);

  /// Of the twin's messages, and of sensor_msgs/JointState, which are measured; else null.
  const MessageKind* kind() const { return kind_; }
  /// What the channels of the twin or machine would begin with on LCM, by the topic's namespace:
  /// MACHINE_ for /machine/measured/probes; "" for a topic without one.
  const std::string& prefix() const { return prefix_; }
  bool isJointState() const { return joint_state_; }

  /// Throws RejectedMessage for what is damaged, cannot be meant, or is about another than its
  /// topic.
  Message decode(const BagMessage& message);

 private:
  Message jointState(const RosValues& values);

  std::string topic_;  ///< below its namespace
  std::string prefix_;
  const MessageKind* kind_ = nullptr;
  bool joint_state_ = false;
  std::optional<RosLayout> layout_;
  std::int64_t blocks_ = 0;  ///< of joint states
};

}  // namespace whirl_twin
