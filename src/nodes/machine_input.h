// A machine's measurements, from wherever they come: its topics, or its LCM channels.
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

  /// From topics measured/SOURCE of the machine's namespace; handler is called by receive().
  MachineInput(const std::string& machine, const std::vector<std::string>& sources,
               Handler handler);
  /// From LCM channels that begin with a prefix.
  MachineInput(const std::string& lcm_url, const std::string& prefix, Handler handler);
  /// Its callbacks refer to it.
  MachineInput(const MachineInput&) = delete;
  MachineInput& operator=(const MachineInput&) = delete;

  /// Takes what has come, and waits for a moment where nothing has; ROS's callbacks, too.
  void receive();
  std::uint64_t taken() const { return taken_; }
  std::uint64_t rejected() const;  ///< messages that were not sound
  std::string lastRejection() const;
  /// Of the run that is followed; what another sends in its place is left and counted.
  const RunFilter& runs() const { return runs_; }
  /// Those that came by LCM and were no messages; null where it does not listen there.
  const RefusedPayloads* refusedPayloads() const {
    return receiver_ ? &receiver_->refused() : nullptr;
  }

 private:
  void take(const state::Measurement& message);
  /// A simulated machine says which run it is.
  void take(const state::LoopStatistics& loop);

  Handler handler_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<LcmReceiver> receiver_;
  RunFilter runs_;
  std::uint64_t taken_ = 0, rejected_ = 0;
  std::string last_rejection_;
};

}  // namespace whirl_twin
