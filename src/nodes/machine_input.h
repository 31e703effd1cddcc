// Subscription to the measurements of a machine, by ROS topics or LCM channels.
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "messages/measurement.h"
#include "monitoring/run_filter.h"
#include "transport/lcm_receiver.h"

namespace whirl_twin {

class MachineInput {
 public:
  using Handler = std::function<void(const state::Measurement&)>;

  /// Subscribes to the topics measured/SOURCE of the machine's namespace; receive() calls handler.
  MachineInput(const std::string& machine, const std::vector<std::string>& sources,
               Handler handler);
  /// Subscribes to the LCM channels that begin with a prefix.
  MachineInput(const std::string& lcm_url, const std::string& prefix, Handler handler);
  /// Not copyable: its callbacks refer to it.
  MachineInput(const MachineInput&) = delete;
  MachineInput& operator=(const MachineInput&) = delete;

  /// Handles the received messages, waiting a moment if there are none; also runs ROS's callbacks.
  void receive();
  std::uint64_t taken() const { return taken_; }
  std::uint64_t rejected() const;  ///< invalid messages
  std::string lastRejection() const;
  /// The filter that selects the tracked run; messages of a different run are discarded and
  /// counted.
  const RunFilter& runs() const { return runs_; }
  /// Malformed payloads received by LCM; null without an LCM subscription.
  const RefusedPayloads* refusedPayloads() const {
    return receiver_ ? &receiver_->refused() : nullptr;
  }

 private:
  void take(const state::Measurement& message);
  /// The loop statistics of a simulated machine identify its run.
  void take(const state::LoopStatistics& loop);

  Handler handler_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<LcmReceiver> receiver_;
  RunFilter runs_;
  std::uint64_t taken_ = 0, rejected_ = 0;
  std::string last_rejection_;
};

}  // namespace whirl_twin
