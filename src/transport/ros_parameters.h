// ROS parameters as YAML: what rosparam loaded from a file, read like the file.
#pragma once

#include <ros/ros.h>
#include <yaml-cpp/yaml.h>

#include <string>

namespace whirl_twin {

struct ParameterTree {
  YAML::Node tree;
  std::string source;  ///< the file, if the parameter NAME_file has it, else the parameter
};

/// The tree of the parameter `name`. Throws InputError if there is none.
ParameterTree parameterTree(const ros::NodeHandle& node, const std::string& name);

/// A parameter as YAML.
YAML::Node toYaml(XmlRpc::XmlRpcValue& value);

/// YAML as a parameter, as rosparam would load it. Throws InputError for a tree too deep or too
/// large for a scene, for example by nested aliases.
XmlRpc::XmlRpcValue fromYaml(const YAML::Node& tree);

}  // namespace whirl_twin
