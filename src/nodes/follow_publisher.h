// All that leaves the node of a follower: the twin's motion as a simulation's, what was measured
// beside it, and what has been learned.
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
  /// Advertises under `node`, and tells the scene; sources: that measure.
  FollowPublisher(Twin& twin, std::shared_ptr<SystemGenerations> generations,
                  const std::vector<std::string>& sources, ros::NodeHandle node, LcmPublisher lcm,
                  state::SceneText scene);

  /// Messages leave on ROS with the next send(); on LCM they have left.
  void send() { states_.send(); }
  /// [ns], of what is published from now on.
  void setStamp(std::int64_t stamp) { stamp_ = stamp; }
  void publish(const double* record);
  void publish(state::FollowState told);
  void publish(const state::Measurement& raw) { states_.tell(raw); }
  /// Nothing has come for so long [s]: what is known, and that every channel is silent; it leaves
  /// at once.
  void publishSilence(double silent, double step_seconds);
  /// On LCM, which latches nothing, once more: the scene, and the parameters as they are known.
  void tellAgain();
  /// The last of each system.
  const std::map<std::string, state::FollowState>& told() const { return told_; }

 private:
  Observer observer_;
  OrderObserver orders_;
  StatePublisher states_;
  state::SceneText scene_;
  std::int64_t stamp_ = 0;  // [ns]
  std::map<std::string, state::FollowState> told_;
};

}  // namespace whirl_twin
