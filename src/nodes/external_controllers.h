// Interface to the controllers in other processes: publishes samples on ROS and LCM, and passes
// commands from either to the loop.
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
  /// Topics controllers/<name>/measurement and /command, for a single output also /command_value;
  /// channels PREFIX<NAME>_SAMPLE and _COMMAND. ROS only with an empty lcm_url, or if LCM is not
  /// available.
  ExternalControllers(const LiveTwin& twin, ros::NodeHandle node, const std::string& lcm_url,
                      const std::string& lcm_prefix);
  ~ExternalControllers();

  bool any() const { return !controllers_.empty(); }
  /// Commands whose length differs from the number of outputs, or that met a full queue.
  std::uint64_t refused() const { return refused_.load(std::memory_order_relaxed); }
  /// Malformed payloads of commands by LCM.
  const RefusedPayloads& malformed() const { return malformed_; }

 private:
  struct Connection {
    std::string name, lcm_channel;
    ExternalLink* link;
    ros::Publisher measurement;
    ros::Subscriber command;
    ros::Subscriber value;    // for a single output
    ExternalSample newest{};  // last one published
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
  ros::CallbackQueue queue_;  // separate, so that commands do not wait for services
  std::shared_ptr<lcm::LCM> lcm_;
  std::vector<std::unique_ptr<ChannelTap>> taps_;
  RefusedPayloads malformed_;
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace whirl_twin
