// Reading a private ROS parameter, with a complaint when it is of another type.
#pragma once

#include <fmt/format.h>
#include <ros/ros.h>

#include <stdexcept>
#include <string>

#include "transport/channels.h"
#include "transport/twin_namespace.h"

namespace whirl_twin {

/// The node's parameter ~name, or `fallback` if it is not set. Throws std::invalid_argument with
/// the full name and what was `expected` if it is there with another type.
template <class Value>
Value privateParameter(const char* name, const char* expected, const Value& fallback) {
  const ros::NodeHandle node("~");
  Value value = fallback;
  if (node.hasParam(name) && !node.getParam(name, value)) {
    throw std::invalid_argument(
        fmt::format("{}: expected {}, found another type", node.resolveName(name), expected));
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
