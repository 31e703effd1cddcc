// The ROS namespace of a node's twin: several twins share one master in separate namespaces.
#pragma once

#include <string>

namespace whirl_twin {

/// Namespace of the topics and the scene of this node's twin: the one the node was started in, or
/// "/twin" if that is the root.
std::string twinNamespace();

}  // namespace whirl_twin
