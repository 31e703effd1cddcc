// Publishes the states of the twin's steps on ROS topics and LCM channels. Used by the publisher
// thread only.
#pragma once

#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "nodes/node_parameters.h"
#include "scene/scene.h"
#include "transport/lcm_publisher.h"
#include "transport/ros_topics.h"
#include "twin/ensemble_observer.h"
#include "twin/step_messages.h"

namespace whirl_twin {

/// [Hz], valid publication rates of states.
inline const ParameterRange kPublishRates{1.0e-3, HUGE_VAL, "Hz", "every step"};

/// Steps of the scene from one publication to the next.
inline std::int64_t stepsToPublish(const Scene& scene, double rate) {
  return rate == 0.0 ? 1
                     : std::max<std::int64_t>(1, std::llround(1.0 / (rate * scene.stepSeconds())));
}

class StatePublisher {
 public:
  /// Advertises every topic of the scene under `node`; `ensembles` are the twin's. clock_period
  /// [ns, simulated]: interval between the states that also publish their stamps on /clock; 0: no
  /// clock. Throws InputError for an LCM prefix that makes a channel too long.
  StatePublisher(const Twin& twin, EnsembleObserver ensembles, ros::NodeHandle node,
                 LcmPublisher lcm, std::int64_t clock_period = 0);

  /// Sends the queued ROS messages; those of latched topics were sent at once.
  void send() { topics_.send(); }
  /// Publishes the observer's present state; all: the messages of every step, else only the changed
  /// parameters. Messages without a subscriber, and channels with LCM off, are not filled.
  void publish(const Observer& observer, bool all);
  /// Publishes the statistics of the ensembles that were updated since the last call, if there are
  /// subscribers, stamped with the observer's time.
  void publishEnsembles(const Observer& observer);
  /// Publishes the orders that are due at the observer's step.
  void publishOrders(const Observer& observer, const OrderObserver& orders);
  /// Republishes unchanged messages on LCM, which has no latched topics: the parameters,
  void republishParameters();
  /// and messages of tell().
  template <class State>
  void tellAgain(const State& state) {
    lcm_.publish(state);
  }
  /// Publishes a message that is not part of a record: loop statistics, measurements, estimates.
  template <class State>
  void tell(const State& state) {
    topics_.publish(state);
    lcm_.publish(state);
  }
  template <class State>
  void advertise(const std::string& subject) {
    topics_.advertise<State>(subject);
  }
  /// Publishes /clock only, for subscribers that join while the twin is paused; requires a clock.
  void publishClock(const Observer& observer);

  const LcmPublisher& lcm() const { return lcm_; }
  const RosTopics& ros() const { return topics_; }

 private:
  const Twin& twin_;
  StepMessages messages_;
  EnsembleObserver ensembles_;
  RosTopics topics_;
  LcmPublisher lcm_;
  ros::Publisher clock_;
  std::int64_t clock_period_;  // [ns]
  std::int64_t last_clock_;    // [ns]
};

}  // namespace whirl_twin
