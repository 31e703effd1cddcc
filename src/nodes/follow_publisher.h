// Publisher of the state estimator node: the estimated motion on the topics of a simulation, the
// measurements, and the estimates.
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "messages/follow_state.h"
#include "messages/measurement.h"
#include "messages/scene_text.h"
#include "nodes/state_publisher.h"
#include "transport/lcm_publisher.h"
#include "twin/observer.h"
#include "twin/order_observer.h"

namespace whirl_twin {

class FollowPublisher {
 public:
  /// Advertises under `node`, and publishes the scene; sources: names of the measurement sources.
  FollowPublisher(Twin& twin, std::shared_ptr<SystemGenerations> generations,
                  const std::vector<std::string>& sources, ros::NodeHandle node, LcmPublisher lcm,
                  state::SceneText scene);

  /// Sends the queued messages on ROS; on LCM they were sent at once.
  void send() { states_.send(); }
  /// [ns], of the messages published from now on.
  void setStamp(std::int64_t stamp) { stamp_ = stamp; }
  void publish(const double* record);
  void publish(state::FollowState state);
  void publish(const state::Measurement& raw) { states_.tell(raw); }
  /// No message for `silent` [s]: publishes and sends the estimates with every channel marked as
  /// timed out.
  void publishSilence(double silent, double step_seconds);
  /// Republishes on LCM, which has no latched topics: the scene, and the present parameters.
  void tellAgain();
  /// The latest of each system.
  const std::map<std::string, state::FollowState>& published() const { return published_; }

 private:
  Observer observer_;
  OrderObserver orders_;
  StatePublisher states_;
  state::SceneText scene_;
  std::int64_t stamp_ = 0;  // [ns]
  std::map<std::string, state::FollowState> published_;
};

}  // namespace whirl_twin
