// LCM in, ROS out: states that arrive on LCM channels (a log being played, a twin on another
// machine) appear on the topics on which a live twin publishes them, unchanged and in order.
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "messages/alert.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {

class LcmBridge {
 public:
  /// Publishes under `twin`, e.g. the namespace /twin. derived: also stability margins and alerts,
  /// which otherwise a live monitor publishes.
  LcmBridge(const ros::NodeHandle& twin, bool derived);

  /// Publishes a state on its topics. The first of a topic waits (at most 2 s) until the nodes that
  /// subscribed to the topic before are connected, so that they get every one.
  void publish(const TwinState& state);

 private:
  void publishState(const state::WhirlState& whirl);
  void publishState(const state::PendulumState& pendulum);
  void publishState(const state::DriveState& drive);
  void publishState(const state::MotorState& motor);
  void publishState(const state::EnsembleState& ensemble);
  void publishState(const state::StabilityMargin& margin);
  void publishState(const state::ParameterChange& change);
  void publishState(const state::Alert& alert);

  template <class Message>
  void publishOn(const std::string& topic, const Message& message, bool latched = false);

  ros::NodeHandle twin_;
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher alert_publisher_;
  std::map<std::uint32_t, state::Alert> active_alerts_;  ///< by id
  double last_alert_time_ = 0.0;                         ///< [s], simulated
};

}  // namespace whirl_twin
