// What a node does about its ROS master: when the master has been restarted the node registers its
// topics, services and parameters again, so that it is found as before. Another node that publishes
// on the topics of this node's twin is named, and so are clocks: /use_sim_time without a publisher
// of /clock, and several publishers of it.
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace whirl_twin {

/// The time for stamps [ns]: ROS's, but of the wall while /use_sim_time is set and no /clock has
/// come, as states have it. All nodes of a twin take stamps from here.
std::int64_t stampNow();

class MasterWatch {
 public:
  /// Looks at the master every two seconds, in a thread of its own, once the node has started.
  /// `parameters`: names of further trees to bring back, beside the node's own and /use_sim_time.
  explicit MasterWatch(std::vector<std::string> parameters = {});
  ~MasterWatch();
  /// Ends the thread, as must be before ros::shutdown().
  void stop();

  /// What stands in the way at present, in a sentence for the diagnostics; empty: nothing.
  std::string trouble() const;
  /// The node's private parameters as the master held them last; no struct before the first look.
  XmlRpc::XmlRpcValue ownParameters() const;

 private:
  struct Registered {
    std::set<std::string> topics;                                   // this node publishes
    std::set<std::string> services;                                 // this node gives
    std::map<std::string, std::set<std::string>> other_publishers;  // of topics
    std::set<std::string> clocks;                                   // that publish /clock
  };

  void run();
  void look();
  Registered registered(XmlRpc::XmlRpcValue& state) const;
  void rememberParameters();
  void tellAll() const;
  void reportRivals(const Registered& now);
  void reportClocks(const Registered& now);

  std::vector<std::string> parameter_names_;
  std::map<std::string, XmlRpc::XmlRpcValue> parameters_;
  XmlRpc::XmlRpcValue own_parameters_;
  std::set<std::string> services_;  // ever registered
  bool answered_ = true;
  std::set<std::string> rivals_;
  int looks_without_clock_ = 0;
  std::string clock_trouble_;
  mutable std::mutex mutex_;
  std::string trouble_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace whirl_twin
