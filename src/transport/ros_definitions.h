// ROS definitions of our messages, generated from msg/*.msg at build time (cmake/ros_definitions),
// so that files for ROS tools are written without ROS.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

struct RosDefinition {
  const char* type;    ///< "whirl_twin/WhirlState"
  const char* text;    ///< the .msg file and those it includes, as rosbag stores them
  const char* md5sum;  ///< by which ROS identifies the version of a message
  /// The primitive fields in order: b of 1 byte, i of 4, l of 8, d float64, s string; arrays in
  /// capitals.
  const char* widths;
};

const std::vector<RosDefinition>& rosDefinitions();

}  // namespace whirl_twin
