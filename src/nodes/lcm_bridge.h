// LCM in, ROS out: messages that arrive on LCM channels (a log being played, a twin on another
// machine) appear on the topics on which a live twin publishes them, unchanged and in order.
#pragma once

#include <ros/ros.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "messages/message.h"
#include "realtime/timing_histogram.h"
#include "transport/ros_topics.h"

namespace whirl_twin {

// Of states that come faster than they are wanted, the newest of each; what is news (parameters,
// alerts, the loop's statistics) is passed on at once, behind the states before it.

class NewestStates {
 public:
  /// period: from one telling of the newest to the next; 0: every message at once. now() [us] is
  /// the clock that says when messages arrived.
  NewestStates(std::chrono::microseconds period, std::function<void(const Message&)> tell,
               std::function<std::int64_t()> now);

  /// arrived [us].
  void take(const Message& message, std::int64_t arrived);
  /// Tells what is due; to be called as often as nextDue() says.
  void tellDue();
  /// How long until there is something to tell [us]; at most `longest`.
  std::chrono::microseconds nextDue(std::chrono::microseconds longest) const;

  /// States that a newer one has taken the place of.
  std::uint64_t leftOut() const { return left_out_; }
  /// [ns], from arrival to having been told.
  const TimingHistogram& latency() const { return latency_; }

 private:
  struct Kept {
    Message message;
    std::int64_t arrived;  // [us]
  };
  void tell(const Message& message, std::int64_t arrived);
  void tellAll();

  std::chrono::microseconds period_;
  std::function<void(const Message&)> tell_;
  std::function<std::int64_t()> now_;
  std::map<std::pair<const MessageKind*, std::string>, Kept> kept_;
  std::int64_t told_;  // [us], when last
  std::uint64_t left_out_ = 0;
  TimingHistogram latency_;
};

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
