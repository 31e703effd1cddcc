#include "transport/ros_parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "messages/input_error.h"

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

namespace {

constexpr int kDeepestParameter = 20;
constexpr int kMaxValues = 1'000'000;

XmlRpc::XmlRpcValue scalarOf(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  const bool inQuotes = node.Tag() == "!";
  if (!inQuotes && (text == "true" || text == "false")) {
    return {text == "true"};
  }
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool begins = !text.empty() && text.find_first_of("+-.0123456789") == 0;
  if (inQuotes || !begins || *end != '\0') {
    return {text};
  }
  const bool whole = text.find_first_not_of("+-0123456789") == std::string::npos;
  if (whole && std::fabs(number) <= std::numeric_limits<int>::max()) {
    return {static_cast<int>(number)};
  }
  return {number};
}

XmlRpc::XmlRpcValue fromYaml(const YAML::Node& node, int depth, int& left) {
  if (depth > kDeepestParameter || --left < 0) {
    throw InputError("exceeds the depth or size of a scene");
  }
  XmlRpc::XmlRpcValue value;
  if (node.IsMap()) {
    value.begin();  // makes it a struct
    for (const auto& member : node) {
      value[member.first.Scalar()] = fromYaml(member.second, depth + 1, left);
    }
  } else if (node.IsSequence()) {
    value.setSize(0);
    for (std::size_t i = 0; i < node.size(); ++i) {
      value[static_cast<int>(i)] = fromYaml(node[i], depth + 1, left);
    }
  } else if (node.IsScalar()) {
    return scalarOf(node);
  } else {
    return {""};
  }
  return value;
}

}  // namespace

XmlRpc::XmlRpcValue fromYaml(const YAML::Node& tree) {
  int left = kMaxValues;
  return fromYaml(tree, 0, left);
}

ParameterTree parameterTree(const ros::NodeHandle& node, const std::string& name) {
  const std::string source =
      node.param<std::string>(name + "_file", "parameter " + node.resolveName(name));
  XmlRpc::XmlRpcValue tree;
  if (!node.getParam(name, tree)) {
    throw InputError(
        fmt::format("{}: missing; load {} with <rosparam command=\"load\" file=\"...\" ns=\"{}\"/>",
                    source, name, node.resolveName(name)));
  }
  return {toYaml(tree), source};
}

}  // namespace whirl_twin
