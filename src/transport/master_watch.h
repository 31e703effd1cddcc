// Watches the ROS master: after a restart of the master the node registers its topics, services and
// parameters again. Reports other nodes that publish on the topics of this node's twin,
// /use_sim_time without a publisher of /clock, and several publishers of /clock.
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

/// The time for stamps [ns]: ROS time, or wall-clock time while /use_sim_time is set and no /clock
/// has arrived. All nodes of a twin take stamps from here.
std::int64_t stampNow();

class MasterWatch {
 public:
  /// Polls the master every two seconds, in a separate thread, once the node has started.
  /// `parameters`: names of further parameter trees to restore, beside the node's own and
  /// /use_sim_time.
  explicit MasterWatch(std::vector<std::string> parameters = {});
  ~MasterWatch();
  /// Stops the thread; must be called before ros::shutdown().
  void stop();

  /// The present fault, a sentence for the diagnostics; "" if there is none.
  std::string trouble() const;
  /// The node's private parameters as last read from the master; not a struct before the first
  /// poll.
  XmlRpc::XmlRpcValue ownParameters() const;

 private:
  struct Registered {
    std::set<std::string> topics;                                   // published by this node
    std::set<std::string> services;                                 // offered by this node
    std::map<std::string, std::set<std::string>> other_publishers;  // of topics
    std::set<std::string> clocks;                                   // publishers of /clock
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
