// What ROS knows of our messages, made of msg/*.msg when the twin is built (cmake/ros_definitions):
// no ROS is needed to write files for its tools.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

struct RosDefinition {
  const char* type;    ///< "whirl_twin/WhirlState"
  const char* text;    ///< the .msg file and those that it names, as rosbag stores them
  const char* md5sum;  ///< that ROS tells versions of a message apart by
  /// Of each field that is no message, in order: b of 1 byte, i of 4, l of 8, d float64, s string;
  /// of arrays in capitals.
  const char* widths;
};

const std::vector<RosDefinition>& rosDefinitions();

}  // namespace whirl_twin
