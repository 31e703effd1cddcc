#include "transport/ros_parameters.h"

#include <fmt/format.h>

#include "messages/refusal.h"

namespace whirl_twin {

YAML::Node toYaml(XmlRpc::XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeStruct: {
      YAML::Node map(YAML::NodeType::Map);
      for (auto& member : value) {
        map[member.first] = toYaml(member.second);
      }
      return map;
    }
    case XmlRpc::XmlRpcValue::TypeArray: {
      YAML::Node list(YAML::NodeType::Sequence);
      // NOLINTNEXTLINE(modernize-loop-convert): XmlRpcValue iterates structs only.
      for (int i = 0; i < value.size(); ++i) {
        list.push_back(toYaml(value[i]));
      }
      return list;
    }
    case XmlRpc::XmlRpcValue::TypeDouble:
      return YAML::Node(fmt::format("{}", static_cast<double>(value)));
    case XmlRpc::XmlRpcValue::TypeInt:
      return YAML::Node(fmt::format("{}", static_cast<int>(value)));
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value) ? "true" : "false");
    case XmlRpc::XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    default:
      return YAML::Node(YAML::NodeType::Null);
  }
}

ParameterTree parameterTree(const ros::NodeHandle& node, const std::string& name) {
  const std::string source =
      node.param<std::string>(name + "_file", "parameter " + node.resolveName(name));
  XmlRpc::XmlRpcValue tree;
  if (!node.getParam(name, tree)) {
    throw Refusal(fmt::format(
        "{}: no {} there; load one with <rosparam command=\"load\" file=\"...\" ns=\"{}\"/>",
        source, name, node.resolveName(name)));
  }
  return {toYaml(tree), source};
}

}  // namespace whirl_twin
