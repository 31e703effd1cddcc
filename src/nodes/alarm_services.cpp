#include "nodes/alarm_services.h"

#include <chrono>
#include <utility>
#include <variant>

#include "messages/names.h"
#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/ros_converters.h"

namespace whirl_twin {

namespace {

constexpr std::uint32_t kAlarmQueue = 100;  // commands

template <class Response>
bool tell(const CommandAnswer& given, Response& response) {
  response.success = given.done;
  response.message = given.text;
  return true;
}

}  // namespace

template <class Event>
ros::ServiceServer AlarmServices::advertise(ros::NodeHandle& node, const std::string& name,
                                            bool (AlarmServices::*serve)(Event&)) {
  ros::AdvertiseServiceOptions options;
  options.initBySpecType<Event>(name, [this, serve](Event& call) { return (this->*serve)(call); });
  return node.advertiseService(options);
}

AlarmServices::AlarmServices(TwinMonitor& monitor, const ros::NodeHandle& own, ros::NodeHandle twin,
                             std::function<double()> wall_time, std::function<void()> was_reset)
    : monitor_(monitor), wall_time_(std::move(wall_time)), was_reset_(std::move(was_reset)) {
  ros::NodeHandle node = own;
  servers_ = {advertise(node, "acknowledge", &AlarmServices::acknowledge),
              advertise(node, "reset_alarms", &AlarmServices::reset),
              advertise(node, "inhibit", &AlarmServices::inhibit)};
  const boost::function<void(const ros::MessageEvent<const AlarmCommand>&)> callback =
      [this](const ros::MessageEvent<const AlarmCommand>& event) {
        try {
          take(fromRos(*event.getConstMessage()), printable(event.getPublisherName()));
        } catch (const RejectedMessage& why) {
          refuse(why.what());
        }
      };
  ros::SubscribeOptions options;
  options.initByFullCallbackType<const ros::MessageEvent<const AlarmCommand>&>(
      topicName(state::AlarmCommand::kKind), kAlarmQueue, callback);
  subscriber_ = twin.subscribe(options);
}

void AlarmServices::listen(const std::string& lcm_url, const std::string& lcm_prefix) {
  try {
    receiver_ = std::make_unique<LcmReceiver>(
        openLcm(lcm_url), Kinds{&state::AlarmCommand::kKind},
        [this](const Message& message) {
          take(std::get<state::AlarmCommand>(message), "a message on LCM");
        },
        lcm_prefix);
  } catch (const LcmNotAvailable& problem) {
    ROS_WARN("%s; alarm commands are accepted on ROS only", problem.what());
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

CommandAnswer AlarmServices::answer(const state::AlarmCommand& command, const std::string& by) {
  CommandAnswer answer = carryOut(command, monitor_, wall_time_(), by);
  if (answer.done && command.command == state::AlarmCommand::kReset) {
    was_reset_();
  }
  if (answer.done) {
    ROS_WARN("%s (by %s)", answer.text.c_str(), by.c_str());
  }
  return answer;
}

void AlarmServices::take(const state::AlarmCommand& command, const std::string& by) {
  const CommandAnswer given = answer(command, by);
  if (!given.done) {
    return refuse(given.text);
  }
  ++taken_;
}

void AlarmServices::refuse(const std::string& why) {
  ++refused_;
  ROS_WARN_THROTTLE(5.0, "an alarm command is refused: %s", why.c_str());
}

bool AlarmServices::acknowledge(
    ros::ServiceEvent<Acknowledge::Request, Acknowledge::Response>& call) {
  state::AlarmCommand command;
  command.command = state::AlarmCommand::kAcknowledge;
  command.system = call.getRequest().system;
  command.type = call.getRequest().type;
  return tell(answer(command, printable(call.getCallerName())), call.getResponse());
}

bool AlarmServices::reset(
    ros::ServiceEvent<std_srvs::Trigger::Request, std_srvs::Trigger::Response>& call) {
  state::AlarmCommand command;
  command.command = state::AlarmCommand::kReset;
  return tell(answer(command, printable(call.getCallerName())), call.getResponse());
}

bool AlarmServices::inhibit(ros::ServiceEvent<Inhibit::Request, Inhibit::Response>& call) {
  state::AlarmCommand command;
  command.command = state::AlarmCommand::kInhibit;
  command.system = call.getRequest().system;
  command.duration = call.getRequest().duration;
  return tell(answer(command, printable(call.getCallerName())), call.getResponse());
}

}  // namespace whirl_twin
