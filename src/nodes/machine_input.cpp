#include "nodes/machine_input.h"

#include <ros/callback_queue.h>
#include <whirl_twin/Measurement.h>

#include <chrono>
#include <utility>
#include <variant>

#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/ros_converters.h"

namespace whirl_twin {

namespace {

constexpr std::uint32_t kBlockQueue = 1000;  // blocks
constexpr std::chrono::milliseconds kBlockPoll{2};

}  // namespace

MachineInput::MachineInput(const std::string& machine, const std::vector<std::string>& sources,
                           Handler handler)
    : handler_(std::move(handler)) {
  ros::NodeHandle node(machine);
  for (const std::string& source : sources) {
    const boost::function<void(const boost::shared_ptr<const Measurement>&)> callback =
        [this](const boost::shared_ptr<const Measurement>& message) {
          try {
            take(fromRos(*message));
          } catch (const RejectedMessage& why) {
            ++rejected_;
            last_rejection_ = why.what();
          }
        };
    subscribers_.push_back(node.subscribe<Measurement>(topicName(state::Measurement::kKind, source),
                                                       kBlockQueue, callback, ros::VoidConstPtr(),
                                                       ros::TransportHints().tcpNoDelay()));
  }
}

MachineInput::MachineInput(const std::string& lcm_url, const std::string& prefix, Handler handler)
    : handler_(std::move(handler)),
      receiver_(std::make_unique<LcmReceiver>(
          openLcm(lcm_url), Kinds{&state::Measurement::kKind},
          [this](const Message& message) { take(std::get<state::Measurement>(message)); },
          prefix)) {}

void MachineInput::take(const state::Measurement& message) {
  ++taken_;
  handler_(message);
}

void MachineInput::receive() {
  if (receiver_) {
    receiver_->receive(kBlockPoll);
  }
  ros::getGlobalCallbackQueue()->callAvailable(
      ros::WallDuration(receiver_ ? 0.0 : std::chrono::duration<double>(kBlockPoll).count()));
}

std::uint64_t MachineInput::rejected() const {
  return rejected_ + (receiver_ ? receiver_->rejected() : 0);
}

std::string MachineInput::lastRejection() const {
  return receiver_ ? receiver_->refused().last() : last_rejection_;
}

}  // namespace whirl_twin
