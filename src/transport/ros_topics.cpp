#include "transport/ros_topics.h"

#include <ros/publication.h>

namespace whirl_twin {

std::vector<TopicLink> linksOf(const std::string& topic) {
  const ros::PublicationPtr publication = ros::TopicManager::instance()->lookupPublication(topic);
  std::vector<TopicLink> found;
  if (!publication) {
    return found;
  }
  XmlRpc::XmlRpcValue links;
  links.setSize(0);
  publication->getInfo(links);  // [[connection, node, ...], ...]
  // NOLINTNEXTLINE(modernize-loop-convert): XmlRpcValue iterates structs only.
  for (int i = 0; i < links.size(); ++i) {
    found.push_back({links[i][0], links[i][1]});
  }
  return found;
}

std::vector<std::string> listenersOf(const std::string& topic) {
  std::vector<std::string> nodes;
  for (const TopicLink& link : linksOf(topic)) {
    nodes.push_back(link.node);
  }
  return nodes;
}

void RosTopics::send(const ros::Publisher& publisher, BatchedPublisher& messages) {
  const std::uint64_t before = messages.lost();
  const std::string topic = publisher.getTopic();
  messages.send(topic);
  if (messages.lost() > before) {
    lost_ += messages.lost() - before;
    lost_last_ = topic;
  }
}

void RosTopics::send() {
  bool any = false;
  for (auto& [kind, subjects] : topics_) {
    for (auto& [subject, topics] : subjects) {
      if (!topics.states.empty()) {
        any = true;
        send(topics.state, topics.states);
      }
      if (!topics.joint_state_list.empty()) {
        any = true;
        send(topics.joint_states, topics.joint_state_list);
      }
    }
  }
  if (any) {
    wakeSender();
  }
}

void RosTopics::publishAlerts(const std::vector<state::Alert>& alerts, std::int64_t stamp) {
  topicsOf<state::Alert>("").state.publish(toRos(alerts, stamp));
}

}  // namespace whirl_twin
