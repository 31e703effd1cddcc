#include "nodes/alarm_services.h"

#include <chrono>
#include <utility>
#include <variant>

#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/ros_converters.h"

namespace whirl_twin {

namespace {

constexpr std::uint32_t kAlarmQueue = 100;  // commands of a sender that is ahead

template <class Response>
bool tell(const CommandAnswer& given, Response& response) {
  response.success = given.done;
  response.message = given.text;
  return true;
}

}  // namespace

AlarmServices::AlarmServices(TwinMonitor& monitor, const ros::NodeHandle& own, ros::NodeHandle twin,
                             std::function<double()> wall_time, std::function<void()> was_reset)
    : monitor_(monitor), wall_time_(std::move(wall_time)), was_reset_(std::move(was_reset)) {
  ros::NodeHandle node = own;
  servers_ = {node.advertiseService("acknowledge", &AlarmServices::acknowledge, this),
              node.advertiseService("reset_alarms", &AlarmServices::reset, this),
              node.advertiseService("inhibit", &AlarmServices::inhibit, this)};
  const boost::function<void(const boost::shared_ptr<const AlarmCommand>&)> callback =
      [this](const boost::shared_ptr<const AlarmCommand>& message) {
        try {
          take(fromRos(*message));
        } catch (const RejectedMessage& why) {
          refuse(why.what());
        }
      };
  subscriber_ =
      twin.subscribe<AlarmCommand>(topicName(state::AlarmCommand::kKind), kAlarmQueue, callback);
}

void AlarmServices::listen(const std::string& lcm_url, const std::string& lcm_prefix) {
  try {
    receiver_ = std::make_unique<LcmReceiver>(
        openLcm(lcm_url), Kinds{&state::AlarmCommand::kKind},
        [this](const Message& message) { take(std::get<state::AlarmCommand>(message)); },
        lcm_prefix);
  } catch (const LcmNotAvailable& problem) {
    ROS_WARN("%s; commands about alarms are taken on ROS only", problem.what());
  }
}

void AlarmServices::receive() {
  if (receiver_) {
    receiver_->receive(std::chrono::milliseconds(0));
  }
}

std::uint64_t AlarmServices::refused() const {
  return refused_ + (receiver_ ? receiver_->rejected() : 0);
}

CommandAnswer AlarmServices::answer(const state::AlarmCommand& command) {
  CommandAnswer answer = carryOut(command, monitor_, wall_time_());
  if (answer.done && command.command == state::AlarmCommand::kReset) {
    was_reset_();
  }
  if (answer.done && command.command == state::AlarmCommand::kInhibit && command.duration > 0.0) {
    ROS_WARN("%s", answer.text.c_str());
  }
  return answer;
}

void AlarmServices::take(const state::AlarmCommand& command) {
  const CommandAnswer given = answer(command);
  if (!given.done) {
    return refuse(given.text);
  }
  ++taken_;
}

void AlarmServices::refuse(const std::string& why) {
  ++refused_;
  ROS_WARN_THROTTLE(5.0, "a command about alarms is refused: %s", why.c_str());
}

bool AlarmServices::acknowledge(Acknowledge::Request& request, Acknowledge::Response& response) {
  state::AlarmCommand command;
  command.command = state::AlarmCommand::kAcknowledge;
  command.system = request.system;
  command.type = request.type;
  return tell(answer(command), response);
}

bool AlarmServices::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  state::AlarmCommand command;
  command.command = state::AlarmCommand::kReset;
  return tell(answer(command), response);
}

bool AlarmServices::inhibit(Inhibit::Request& request, Inhibit::Response& response) {
  state::AlarmCommand command;
  command.command = state::AlarmCommand::kInhibit;
  command.system = request.system;
  command.duration = request.duration;
  return tell(answer(command), response);
}

}  // namespace whirl_twin
