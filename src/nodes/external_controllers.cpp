#include "nodes/external_controllers.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <utility>

#include "controllers/external.h"
#include "std_msgs/Float64.h"
#include "transport/lcm_connection.h"
#include "transport/payload_layout.h"
#include "whirl_twin/ControllerCommand.h"
#include "whirl_twin/ControllerMeasurement.h"
#include "whirl_twin/controller_measurement_t.hpp"

namespace whirl_twin {

namespace {

constexpr std::uint32_t kControllerQueue = 1000;
constexpr const char* kCommandEnding = "_COMMAND";
constexpr int kMaxCommandsAtOnce = 1000;
constexpr std::chrono::microseconds kControllerPoll{100};

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

}  // namespace

ExternalControllers::ExternalControllers(const LiveTwin& twin, ros::NodeHandle node,
                                         const std::string& lcm_url,
                                         const std::string& lcm_prefix) {
  const Twin& running = twin.twin();
  node.setCallbackQueue(&queue_);
  for (std::size_t i = 0; i < running.scene().controllers.size(); ++i) {
    if (ExternalController* const external = running.control().controllers()[i].external()) {
      const std::string& name = running.scene().controllers[i].name;
      controllers_.push_back(std::make_unique<Connection>());
      Connection& connection = *controllers_.back();
      connection.name = name;
      connection.lcm_channel = lcm_prefix + upper(name);
      connection.link = &external->link();
      advertise(connection, node);
      if (connection.link->outputs() == 1) {
        advertiseValue(connection, node);
      }
    }
  }
  if (!any()) {
    return;
  }
  if (!lcm_url.empty()) {
    listenOnLcm(lcm_url);
  }
  thread_ = std::thread([this] { run(); });
}

ExternalControllers::~ExternalControllers() {
  ending_.store(true);
  if (thread_.joinable()) {
    thread_.join();
  }
}

void ExternalControllers::advertise(Connection& connection, ros::NodeHandle& node) {
  const std::string topic = "controllers/" + connection.name;
  connection.measurement =
      node.advertise<ControllerMeasurement>(topic + "/measurement", kControllerQueue);
  const boost::function<void(const ControllerCommand::ConstPtr&)> callback =
      [this, &connection](const ControllerCommand::ConstPtr& message) {
        take(connection, {message->run, message->sample, message->time, message->values});
      };
  connection.command =
      node.subscribe<ControllerCommand>(topic + "/command", kControllerQueue, callback,
                                        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

/// A command without a sample number: it counts as the answer to the newest sample.
void ExternalControllers::advertiseValue(Connection& connection, ros::NodeHandle& node) {
  const boost::function<void(const std_msgs::Float64::ConstPtr&)> callback =
      [this, &connection](const std_msgs::Float64::ConstPtr& message) {
        ExternalSample command = connection.newest;
        command.values = {message->data};
        take(connection, command);
      };
  connection.value = node.subscribe<std_msgs::Float64>(
      "controllers/" + connection.name + "/command_value", kControllerQueue, callback,
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

void ExternalControllers::listenOnLcm(const std::string& lcm_url) {
  try {
    lcm_ = openLcm(lcm_url);
    tapCommands();
  } catch (const LcmNotAvailable& problem) {
    ROS_WARN("%s; controllers in other processes are received on ROS only", problem.what());
  }
}

void ExternalControllers::tapCommands() {
  for (const auto& connection : controllers_) {
    const auto take = [this, &connection = *connection](
                          const std::string& channel, std::int64_t, const std::uint8_t* data,
                          std::size_t size) { takeFromLcm(connection, channel, data, size); };
    taps_.push_back(std::make_unique<ChannelTap>(lcm_, connection->lcm_channel + kCommandEnding,
                                                 take, static_cast<int>(kControllerQueue)));
  }
}

void ExternalControllers::takeFromLcm(const Connection& connection, const std::string& channel,
                                      const void* data, std::size_t size) {
  try {
    const auto message =
        decodePayload<controller_command_t>(layoutOf<state::ControllerCommand>(), data, size);
    take(connection, {message.run, message.sample, message.time, message.values});
  } catch (const RejectedMessage& why) {
    malformed_.add(channel, why.what());
  }
}

void ExternalControllers::run() {
  ExternalSample sample;
  while (!ending_.load()) {
    for (const auto& connection : controllers_) {
      while (connection->link->take(sample)) {
        tell(*connection, sample);
      }
    }
    queue_.callAvailable(ros::WallDuration(0.0));
    if (lcm_) {
      handleArrived(*lcm_, std::chrono::microseconds(0), kMaxCommandsAtOnce);
    }
    std::this_thread::sleep_for(kControllerPoll);
  }
}

void ExternalControllers::take(const Connection& connection, const ExternalSample& command) {
  if (!connection.link->answer(command)) {
    refused_.fetch_add(1, std::memory_order_relaxed);
    ROS_WARN_THROTTLE(5.0, "controller %s: a command is refused: must have %zu values, found %zu",
                      connection.name.c_str(), connection.link->outputs(), command.values.size());
  }
}

void ExternalControllers::tell(Connection& connection, const ExternalSample& sample) {
  connection.newest = sample;
  ControllerMeasurement message;
  message.header.stamp.fromNSec(static_cast<std::uint64_t>(ros::WallTime::now().toNSec()));
  message.header.frame_id = connection.name;
  message.sample = sample.sample;
  message.time = sample.time;
  message.values = sample.values;
  message.run = sample.run;
  connection.measurement.publish(message);
  if (lcm_) {
    controller_measurement_t sample_message;
    sample_message.utime = std::llround(sample.time * 1e6);
    sample_message.controller = connection.name;
    sample_message.sample = sample.sample;
    sample_message.time = sample.time;
    sample_message.count = static_cast<std::int32_t>(sample.values.size());
    sample_message.values = sample.values;
    sample_message.run = sample.run;
    lcm_->publish(connection.lcm_channel + "_SAMPLE", &sample_message);
  }
}

}  // namespace whirl_twin
