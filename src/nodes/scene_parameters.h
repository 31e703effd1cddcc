// The scene out of ROS parameters: the same tree as the file, through the same parser.
#pragma once

#include <ros/ros.h>
#include <yaml-cpp/yaml.h>

#include "scene/scene.h"

namespace whirl_twin {

/// The scene under the parameter `name` (loaded by rosparam from a scene file); NAME_file, if set,
/// names the file in messages. Throws SceneError.
Scene sceneFromParameters(const ros::NodeHandle& node, const std::string& name);

/// A parameter tree as YAML.
YAML::Node toYaml(XmlRpc::XmlRpcValue& value);

}  // namespace whirl_twin
