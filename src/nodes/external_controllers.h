// The controllers of a scene that are in other processes: samples go out on ROS and LCM, commands
// come in on either and go to the loop.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "transport/channel_tap.h"
#include "transport/refused_payloads.h"
#include "twin/live_twin.h"

namespace whirl_twin {

class ExternalControllers {
 public:
  /// controllers/<name>/measurement and /command, of one with a single output also /command_value,
  /// PREFIX<NAME>_SAMPLE and _COMMAND; lcm_url "": ROS alone, as where LCM is not available.
  ExternalControllers(const LiveTwin& twin, ros::NodeHandle node, const std::string& lcm_url,
                      const std::string& lcm_prefix);
  ~ExternalControllers();

  bool any() const { return !controllers_.empty(); }
  /// Commands that were of another length than its outputs, or found no room.
  std::uint64_t refused() const { return refused_.load(std::memory_order_relaxed); }
  /// Commands by LCM that were no such message.
  const RefusedPayloads& malformed() const { return malformed_; }

 private:
  struct Connection {
    std::string name, lcm_channel;
    ExternalLink* link;
    ros::Publisher measurement;
    ros::Subscriber command;
    ros::Subscriber value;    // of one with a single output
    ExternalSample newest{};  // told
  };

  void advertise(Connection& connection, ros::NodeHandle& node);
  void advertiseValue(Connection& connection, ros::NodeHandle& node);
  void listenOnLcm(const std::string& lcm_url);
  void tapCommands();
  void takeFromLcm(const Connection& connection, const std::string& channel, const void* data,
                   std::size_t size);
  void run();
  void take(const Connection& connection, const ExternalSample& command);
  void tell(Connection& connection, const ExternalSample& sample);

  std::vector<std::unique_ptr<Connection>> controllers_;
  ros::CallbackQueue queue_;  // that answers wait for no service
  std::shared_ptr<lcm::LCM> lcm_;
  std::vector<std::unique_ptr<ChannelTap>> taps_;
  RefusedPayloads malformed_;
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace whirl_twin
