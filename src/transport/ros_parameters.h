// A tree of ROS parameters as YAML: what rosparam loaded from a file, read like the file.
#pragma once

#include <ros/ros.h>
#include <yaml-cpp/yaml.h>

#include <string>

namespace whirl_twin {

struct ParameterTree {
  YAML::Node tree;
  std::string
      source;  ///< names it in messages: the file, if NAME_file says which, or the parameter
};

/// The tree under the parameter `name`. Throws Refusal if there is none.
ParameterTree parameterTree(const ros::NodeHandle& node, const std::string& name);

/// A parameter as YAML.
YAML::Node toYaml(XmlRpc::XmlRpcValue& value);

/// YAML as a parameter, as rosparam would load it. Throws Refusal for one that is too deep or too
/// large for a scene, as a few lines of aliases make it.
XmlRpc::XmlRpcValue fromYaml(const YAML::Node& tree);

}  // namespace whirl_twin
