#include "nodes/machine_input.h"

#include <ros/callback_queue.h>
#include <whirl_twin/LoopStatistics.h>
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
  const auto listen = [&](auto kind, const std::string& source) {
    using State = typename decltype(kind)::State;
    using Type = RosType<State>;
    const boost::function<void(const boost::shared_ptr<const Type>&)> callback =
        [this](const boost::shared_ptr<const Type>& message) {
          try {
            take(fromRos(*message));
          } catch (const RejectedMessage& why) {
            ++rejected_;
            last_rejection_ = why.what();
          }
        };
    subscribers_.push_back(node.subscribe<Type>(topicName(State::kKind, source), kBlockQueue,
                                                callback, ros::VoidConstPtr(),
                                                ros::TransportHints().tcpNoDelay()));
  };
  for (const std::string& source : sources) {
    listen(KindOf<state::Measurement>{}, source);
  }
  listen(KindOf<state::LoopStatistics>{}, "");
}

MachineInput::MachineInput(const std::string& lcm_url, const std::string& prefix, Handler handler)
    : handler_(std::move(handler)),
      receiver_(std::make_unique<LcmReceiver>(
          openLcm(lcm_url), kindsOf<state::Measurement, state::LoopStatistics>(),
          [this](const Message& message) {
            if (const auto* loop = std::get_if<state::LoopStatistics>(&message)) {
              take(*loop);
            } else {
              take(std::get<state::Measurement>(message));
            }
          },
          prefix)) {}

void MachineInput::take(const state::LoopStatistics& loop) {
  static_cast<void>(runs_.take(Message(loop), ros::SteadyTime::now().toSec()));
}

void MachineInput::take(const state::Measurement& message) {
  if (runs_.take(message.at.stamp, message.at.time, ros::SteadyTime::now().toSec())) {
    ++taken_;
    handler_(message);
  }
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
