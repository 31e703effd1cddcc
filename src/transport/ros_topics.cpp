#include "transport/ros_topics.h"

#include <ros/publication.h>

namespace whirl_twin {

std::vector<std::string> listenersOf(const std::string& topic) {
  const ros::PublicationPtr publication = ros::TopicManager::instance()->lookupPublication(topic);
  std::vector<std::string> nodes;
  if (!publication) {
    return nodes;
  }
  XmlRpc::XmlRpcValue links;
  links.setSize(0);
  publication->getInfo(links);  // [[connection, node, ...], ...]
  // NOLINTNEXTLINE(modernize-loop-convert): XmlRpcValue iterates structs only.
  for (int i = 0; i < links.size(); ++i) {
    nodes.push_back(links[i][1]);
  }
  return nodes;
}

void RosTopics::publishAlerts(const std::vector<state::Alert>& alerts, std::int64_t stamp) {
  topicsOf<state::Alert>("").state.publish(toRos(alerts, stamp));
}

}  // namespace whirl_twin
