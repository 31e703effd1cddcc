// Services of a remote simulation: each request is sent by LCM as a command, and answered when its
// answer arrives.
#pragma once

#include <ros/ros.h>

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "nodes/command_channels.h"
#include "realtime/timing_histogram.h"

namespace whirl_twin {

class CommandSender {
 public:
  /// Advertises under `node`; its services may be called from several threads. timeout [s]: for an
  /// answer. `channels` must outlive it.
  CommandSender(CommandChannels& channels, ros::NodeHandle node, std::string name, double timeout);

  // Any thread.
  std::uint64_t sent() const;
  std::uint64_t unanswered() const;
  TimingHistogram latency() const;  ///< [ns], from sending to the answer

 private:
  template <class Service>
  void advertise(ros::NodeHandle& node, const std::string& command);
  std::optional<command_answer_t> exchange(twin_command_t command);
  void take(const command_answer_t& answer);

  CommandChannels& channels_;
  std::string name_;
  double timeout_;            // [s]
  mutable std::mutex mutex_;  // guards all below but the servers
  std::condition_variable came_;
  std::map<std::int64_t, std::optional<command_answer_t>> awaited_;  // by command number
  std::int64_t number_ = 0;
  std::uint64_t unanswered_ = 0;
  TimingHistogram latency_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace whirl_twin
