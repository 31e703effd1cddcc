#include "transport/twin_namespace.h"

#include <ros/names.h>
#include <ros/this_node.h>

namespace whirl_twin {

std::string twinNamespace() {
  const std::string given = ros::names::clean(ros::this_node::getNamespace());
  return given.empty() || given == "/" ? "/twin" : ros::names::resolve(given);
}

}  // namespace whirl_twin
