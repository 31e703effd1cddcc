// Decodes a message of a rosbag, which is not trusted, into one of the twin's. ROS's generated
// types are not needed: fields are found by name in the definition in the bag.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "transport/bag_scan.h"
#include "transport/channels.h"
#include "transport/ros_layout.h"

namespace whirl_twin {

/// Decoder of the messages of one connection of a bag.
class BagDecoder {
 public:
  /// Throws RejectedMessage for an invalid definition.
  explicit BagDecoder(const BagConnection& connection);

  /// Of the twin's messages, and of sensor_msgs/JointState (decoded as measurements); else null.
  const MessageKind* kind() const { return kind_; }
  /// LCM prefix of the twin or the machine by the namespace of the topic: MACHINE_ for
  /// /machine/measured/probes; "" for a topic without one.
  const std::string& prefix() const { return prefix_; }
  bool isJointState() const { return joint_state_; }

  /// Throws RejectedMessage for a corrupt or invalid message, or one whose content does not match
  /// its topic.
  Message decode(const BagMessage& message);

 private:
  Message jointState(const RosValues& values);

  std::string topic_;  ///< below its namespace
  std::string prefix_;
  const MessageKind* kind_ = nullptr;
  bool joint_state_ = false;
  std::optional<RosLayout> layout_;
  std::int64_t blocks_ = 0;  ///< number of joint states decoded
};

}  // namespace whirl_twin
