#include "nodes/input_commands.h"

#include <algorithm>
#include <chrono>
#include <variant>

#include "messages/names.h"
#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/ros_converters.h"

namespace whirl_twin {

namespace {

constexpr std::uint32_t kInputQueue = 100;  // commands

bool hasCommandedInput(const BuiltSystem& system) {
  const auto& inputs = system.spec.inputs;
  return std::any_of(inputs.begin(), inputs.end(), [](const auto& input) {
    return input.second.kind == InputSignal::Kind::kHeld;
  });
}

}  // namespace

InputCommands::InputCommands(const LiveTwin& twin, TwinServices& services, ros::NodeHandle node,
                             const std::string& lcm_url, const std::string& lcm_prefix)
    : services_(services) {
  for (const SharedSystem& system : twin.twin().systems()) {
    if (!hasCommandedInput(*system)) {
      continue;
    }
    const std::string name = system->spec.name;
    using Event = ros::MessageEvent<const InputCommand>;
    const boost::function<void(const Event&)> callback = [this, name](const Event& event) {
      takeMessage(event, name);
    };
    subscribers_.push_back(node.subscribe<const Event&>(topicName(state::InputCommand::kKind, name),
                                                        kInputQueue, callback, ros::VoidConstPtr(),
                                                        ros::TransportHints().tcpNoDelay()));
  }
  if (subscribers_.empty() || lcm_url.empty()) {
    return;
  }
  try {
    receiver_ = std::make_unique<LcmReceiver>(
        openLcm(lcm_url), Kinds{&state::InputCommand::kKind},
        [this](const Message& message) {
          take(std::get<state::InputCommand>(message), "a message on LCM");
        },
        lcm_prefix);
  } catch (const LcmNotAvailable& problem) {
    ROS_WARN("%s; inputs can be set on ROS only", problem.what());
  }
}

void InputCommands::receive() {
  if (receiver_) {
    receiver_->receive(std::chrono::milliseconds(0));
  }
}

std::uint64_t InputCommands::refused() const {
  return refused_ + (receiver_ ? receiver_->rejected() : 0);
}

void InputCommands::takeMessage(const ros::MessageEvent<const InputCommand>& event,
                                const std::string& system) {
  InputCommand named = *event.getConstMessage();
  if (named.header.frame_id.empty()) {
    named.header.frame_id = system;
  }
  try {
    const state::InputCommand command = fromRos(named);
    if (command.system != system) {
      return refuse("header.frame_id: expected " + system + " on its topic");
    }
    take(command, printable(event.getPublisherName()));
  } catch (const RejectedMessage& why) {
    refuse(why.what());
  }
}

void InputCommands::take(const state::InputCommand& command, const std::string& by) {
  const std::string why = services_.take(command, by);
  if (!why.empty()) {
    return refuse(why);
  }
  ++taken_;
}

void InputCommands::refuse(const std::string& why) {
  ++refused_;
  ROS_WARN_THROTTLE(5.0, "an input command is refused: %s", why.c_str());
}

}  // namespace whirl_twin
