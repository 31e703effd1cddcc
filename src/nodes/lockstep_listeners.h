// Lockstep on ROS: nodes that are named acknowledge each step that they have dealt with, by its
// number on the topic `lockstep` (std_msgs/Int64); the twin goes no further than they have come.
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
/// publication to the next. Throws Refusal for what is no name of a node, or a duplicate.
Lockstep::Settings lockstepSettings(std::string names, int ahead, double timeout,
                                    std::int64_t every);

class LockstepListeners {
 public:
  /// Before the loop runs, which from then on waits for those who are named.
  LockstepListeners(LiveTwin& live, ros::NodeHandle node, const Lockstep::Settings& settings);
  ~LockstepListeners();

  bool on() const { return lockstep_.on(); }
  /// The thread that publishes: a step is on its way; anew: the first one after a reset.
  void published(std::int64_t step, bool anew);
  /// Those whom simulated time waits for, with what is known of why; any thread.
  std::string waitsFor() const;
  /// Sees who is there, and pauses the twin for one that is overdue; ten times a second.
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
  ros::CallbackQueue queue_;  // an acknowledgement waits for no service
  ros::Subscriber acknowledgements_;
  ros::AsyncSpinner thread_{1, &queue_};
  std::map<std::string, std::set<int>> seen_;  // its connections, at the last look
  std::string told_;                           // to the log
  ros::SteadyTime next_look_;
  std::atomic<std::uint64_t> strays_{0};  // numbers of others, or of steps yet to come
};

}  // namespace whirl_twin
