// Messages of ROS 1 as those of ROS 2: the definition (ros2msg) and the serialization (CDR, version
// 1 of the encoding, little-endian). A header loses `seq`, times and durations are those of
// builtin_interfaces.
#pragma once

#include <cstdint>
#include <string>

#include "transport/little_endian.h"
#include "transport/ros_layout.h"

namespace whirl_twin {

/// "whirl_twin/msg/WhirlState" of "whirl_twin/WhirlState".
std::string ros2TypeName(const std::string& type);

class Ros2Message {
 public:
  /// From the definition of ROS 1 with those that it names. Throws RejectedMessage for an invalid
  /// one.
  explicit Ros2Message(const std::string& definition);

  const std::string& definition() const { return definition_; }
  /// Throws RejectedMessage for bytes that do not match the definition. Valid until the next call.
  const LittleEndian& convert(const std::uint8_t* data, std::size_t size);

 private:
  RosLayout layout_;
  std::string definition_;
  LittleEndian bytes_;
};

}  // namespace whirl_twin
