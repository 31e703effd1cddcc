// Which twin a node belongs to: two of them live under one master in namespaces of their own.
#pragma once

#include <string>

namespace whirl_twin {

/// Where the topics and the scene of this node's twin are: the namespace the node was started in,
/// or "/twin" if that is the root.
std::string twinNamespace();

}  // namespace whirl_twin
