// LCM in, ROS out: messages that arrive on LCM channels (a log being played, a twin on another
// machine) appear on the topics on which a live twin publishes them, unchanged and in order.
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <map>

#include "transport/ros_topics.h"

namespace whirl_twin {

class LcmBridge {
 public:
  /// Publishes under `twin`, e.g. the namespace /twin. derived: also stability margins and alerts,
  /// which otherwise a live monitor publishes.
  LcmBridge(const ros::NodeHandle& twin, bool derived);

  /// Publishes a message on its topics. The first of a topic waits (at most 2 s) until the nodes
  /// that subscribed to the topic before are connected, so that they get every one.
  void publish(const Message& message);

  const RosTopics& topics() const { return topics_; }

 private:
  template <class State>
  void publishState(const State& state) {
    topics_.publish(state);
  }
  void publishState(const state::Alert& alert);

  RosTopics topics_;
  std::map<std::uint32_t, state::Alert> active_alerts_;  ///< by id
  double last_alert_time_ = 0.0;                         ///< [s], simulated
};

}  // namespace whirl_twin
