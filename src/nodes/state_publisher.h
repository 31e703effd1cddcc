// Publishes the twin's states on ROS topics and LCM channels. Belongs to the publisher thread.
#pragma once

#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "transport/lcm_publisher.h"
#include "twin/ensemble_observer.h"
#include "twin/observer.h"

namespace whirl_twin {

class StatePublisher {
 public:
  /// Advertises every topic of the scene under `node`; `ensembles` are the twin's. clock: also
  /// /clock, at most at 250 Hz.
  StatePublisher(const Twin& twin, EnsembleObserver ensembles, ros::NodeHandle node,
                 const std::string& lcm_url, bool clock);

  /// Publishes the parameters of the systems that have others than when last asked; on LCM, which
  /// latches nothing, also from time to time.
  void publishParameters(const Observer& observer);
  /// Publishes what the observer stands at. A system that has stopped is silent. Messages without
  /// a subscriber, and channels with LCM off, are not filled.
  void publish(const Observer& observer);
  /// Publishes the statistics of those ensembles that have newer ones than when last asked, if
  /// somebody listens; the observer says when now is.
  void publishEnsembles(const Observer& observer);
  /// The clock alone, for those who join while the twin is paused; only with clock.
  void publishClock(const Observer& observer);

  const LcmPublisher& lcm() const { return lcm_; }

 private:
  struct Topics {
    ros::Publisher state;  // whirl or pendulum
    ros::Publisher joint_states;
    ros::Publisher parameters;
    std::int64_t generation = -1;  // of the parameters published
    state::ParameterChange parameters_sent;
    double parameters_sent_at = 0.0;  // [s], simulated
  };
  struct EnsembleTopic {
    std::size_t system;
    ros::Publisher publisher;
  };
  std::int64_t clockTime(const Observer& observer) const;  // [ns], simulated
  void publishSystem(const Observer& observer, std::size_t system);
  void publishMotor(const Observer& observer, std::size_t drive);

  const Twin& twin_;
  std::vector<Topics> systems_;
  std::vector<ros::Publisher> drives_;
  std::vector<ros::Publisher> motors_;  // of the drives; null where there is none
  EnsembleObserver ensembles_;
  std::vector<EnsembleTopic> ensemble_topics_;  // of ensembles_.systems()
  ros::Publisher clock_;
  std::int64_t last_clock_ = -1'000'000'000;  // [ns], simulated; before any
  LcmPublisher lcm_;
};

}  // namespace whirl_twin
