// Publishes what leaves the twin's steps on ROS topics and LCM channels. Belongs to the publisher
// thread.
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

/// [Hz], that a node can publish states at.
inline const ParameterRange kPublishRates{1.0e-3, HUGE_VAL, "Hz", "every step"};

/// Steps of the scene from one publication to the next.
inline std::int64_t stepsToPublish(const Scene& scene, double rate) {
  return rate == 0.0 ? 1
                     : std::max<std::int64_t>(1, std::llround(1.0 / (rate * scene.stepSeconds())));
}

class StatePublisher {
 public:
  /// Advertises every topic of the scene under `node`; `ensembles` are the twin's. clock_period
  /// [ns, simulated]: also /clock, the stamps of states so far apart; 0: no clock. Throws Refusal
  /// for an LCM prefix that makes a channel too long.
  StatePublisher(const Twin& twin, EnsembleObserver ensembles, ros::NodeHandle node,
                 LcmPublisher lcm, std::int64_t clock_period = 0);

  /// On ROS messages leave with the next send(), but those of latched topics.
  void send() { topics_.send(); }
  /// Publishes what the observer stands at; all: also what leaves every step, and not only the
  /// parameters that have changed. Messages without a subscriber, and channels with LCM off, are
  /// not filled.
  void publish(const Observer& observer, bool all);
  /// Publishes the statistics of those ensembles that have newer ones than when last asked, if
  /// somebody listens; the observer says when now is.
  void publishEnsembles(const Observer& observer);
  /// Publishes the orders that are due at the observer's step.
  void publishOrders(const Observer& observer, const OrderObserver& orders);
  /// On LCM, which latches nothing, once more what has not changed: the parameters,
  void tellParametersAgain();
  /// and what was told.
  template <class State>
  void tellAgain(const State& state) {
    lcm_.publish(state);
  }
  /// Publishes what does not come from a record: the loop's statistics, what sensors measure, what
  /// a follower has learned.
  template <class State>
  void tell(const State& state) {
    topics_.publish(state);
    lcm_.publish(state);
  }
  template <class State>
  void advertise(const std::string& subject) {
    topics_.advertise<State>(subject);
  }
  /// The clock alone, for those who join while the twin is paused; only with clock.
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
