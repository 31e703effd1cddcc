// Reading a private ROS parameter, with a complaint when it is of another type.
#pragma once

#include <fmt/format.h>
#include <ros/ros.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "messages/names.h"
#include "messages/refusal.h"
#include "transport/channels.h"
#include "transport/twin_namespace.h"

namespace whirl_twin {

/// What ROS's own libraries read of a node's private parameters.
inline const std::vector<std::string> kParametersOfRos{"diagnostic_period",
                                                       "diagnostic_updater_use_fqn", "tf_prefix"};

/// Throws Refusal with every private parameter of the node that is none of these, and none that
/// ROS's own libraries read: one that is misspelt would leave the default in its place without a
/// word.
inline void requireKnownParameters(const std::vector<std::string>& known) {
  const auto isIn = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  XmlRpc::XmlRpcValue all;
  const std::string node = ros::this_node::getName();
  if (!ros::param::get(node, all) || all.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return;
  }
  std::vector<std::string> unknown;
  for (const auto& parameter : all) {
    const std::string& name = parameter.first;
    if (!isIn(known, name) && !isIn(kParametersOfRos, name)) {
      unknown.push_back(
          fmt::format("{}/{}: unknown parameter{}", node, printable(name), hint(name, known)));
    }
  }
  if (!unknown.empty()) {
    throw Refusal(fmt::format("{}", fmt::join(unknown, "\n")));
  }
}

/// The node's parameter ~name, or `fallback` if it is not set. Throws Refusal with
/// the full name and what was `expected` if it is there with another type.
template <class Value>
Value privateParameter(const char* name, const char* expected, const Value& fallback) {
  const ros::NodeHandle node("~");
  Value value = fallback;
  if (!node.hasParam(name)) {
    return value;
  }
  XmlRpc::XmlRpcValue given;  // getParam() itself rounds 50.5 to a whole number
  const bool whole =
      !std::is_same_v<Value, int> ||
      (node.getParam(name, given) && given.getType() == XmlRpc::XmlRpcValue::TypeInt);
  if (!whole || !node.getParam(name, value)) {
    throw Refusal(
        fmt::format("{}: must be {}, found another type", node.resolveName(name), expected));
  }
  return value;
}

/// ~lcm_prefix: what the names of the twin's LCM channels begin with; TWIN_, or the namespace of
/// the twin in capitals. Throws Refusal for one that no channel can have.
inline std::string lcmPrefixParameter() {
  const auto prefix = privateParameter<std::string>("lcm_prefix", "letters, digits and _",
                                                    lcmPrefixOf(twinNamespace()));
  requireLcmPrefix(prefix);
  return prefix;
}

}  // namespace whirl_twin
