// Bridge from LCM to ROS: messages on LCM channels (a played log, a twin on another machine) are
// published on the topics of a live twin, unchanged and in order.
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

// Limits the rate of states: the newest of each is published once per period; other messages
// (parameters, alerts, loop statistics) are published at once, after the states before them.

class NewestStates {
 public:
  /// period: between publications of the newest states; 0: every message at once. now() [us] is the
  /// clock of the arrival times.
  NewestStates(std::chrono::microseconds period, std::function<void(const Message&)> tell,
               std::function<std::int64_t()> now);

  /// arrived: [us], arrival time.
  void take(const Message& message, std::int64_t arrived);
  /// Publishes what is due; to be called after the time nextDue().
  void tellDue();
  /// Time until the next publication is due [us]; at most `longest`.
  std::chrono::microseconds nextDue(std::chrono::microseconds longest) const;

  /// States replaced by a newer one.
  std::uint64_t leftOut() const { return left_out_; }
  /// [ns], from arrival to publication.
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
  std::int64_t published_at_;  // [us], last publication
  std::uint64_t left_out_ = 0;
  TimingHistogram latency_;
};

class LcmBridge {
 public:
  /// Publishes under `twin`, e.g. the namespace /twin. derived: also stability margins and alerts,
  /// which otherwise a live monitor publishes.
  LcmBridge(const ros::NodeHandle& twin, bool derived);

  /// Publishes a message on its topics. The first of a topic waits (at most 2 s) until the nodes
  /// that have subscribed to the topic are connected, so that they receive every message.
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
