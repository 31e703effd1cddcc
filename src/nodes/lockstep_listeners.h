// Lockstep on ROS: the given nodes acknowledge each step that they have processed, by its number on
// the topic `lockstep` (std_msgs/Int64); the twin does not advance beyond their acknowledgements.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Int64.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "twin/live_twin.h"
#include "twin/lockstep.h"

namespace whirl_twin {

/// `names`: nodes, separated by commas; `ahead` publications; `timeout` [s]; `every` steps from one
/// publication to the next. Throws InputError for an illegal or duplicate node name.
Lockstep::Settings lockstepSettings(std::string names, int ahead, double timeout,
                                    std::int64_t every);

class LockstepListeners {
 public:
  /// To be called before the loop runs, which from then on waits for the given nodes.
  LockstepListeners(LiveTwin& live, ros::NodeHandle node, const Lockstep::Settings& settings);
  ~LockstepListeners();

  bool on() const { return lockstep_.on(); }
  /// For the publisher thread: a step is being published; restarted: the first one after a reset.
  void published(std::int64_t step, bool restarted);
  /// The nodes that simulated time waits for, with the reasons known; any thread.
  std::string waitsFor() const;
  /// Checks which nodes are present, and pauses the twin for an overdue one; ten times a second.
  void watch();
  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  using Number = ros::MessageEvent<const std_msgs::Int64>;

  void take(const Number& event);
  std::vector<std::string> acknowledging() const;
  void see();
  void tellNews();

  LiveTwin& live_;
  Lockstep lockstep_;
  ros::CallbackQueue queue_;  // separate, so that acknowledgements do not wait for services
  ros::Subscriber acknowledgements_;
  ros::AsyncSpinner thread_{1, &queue_};
  std::map<std::string, std::set<int>> seen_;  // connections at the last poll
  std::string logged_;                         // last logged
  ros::SteadyTime next_look_;
  std::atomic<std::uint64_t> strays_{0};  // acknowledgements of other nodes, or of future steps
};

}  // namespace whirl_twin
