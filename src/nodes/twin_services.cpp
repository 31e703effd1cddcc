#include "nodes/twin_services.h"

#include <utility>

#include "messages/names.h"

namespace whirl_twin {

namespace {

/// The fields that every service answers with.
template <class Response>
bool answered(const CommandResult& result, Response& response) {
  response.success = result.done;
  response.message = result.message;
  return true;
}

}  // namespace

TwinServices::TwinServices(LiveTwin& twin, ros::NodeHandle node, std::function<bool()> keep_waiting)
    : twin_(twin), commands_(twin, std::move(keep_waiting)) {
  servers_ = {
      node.advertiseService("resume", &TwinServices::resume, this),
      node.advertiseService("reset", &TwinServices::reset, this),
      node.advertiseService("step", &TwinServices::step, this),
      node.advertiseService("set_speed", &TwinServices::setSpeed, this),
      node.advertiseService("set_parameter", &TwinServices::setParameter, this),
      node.advertiseService("set_real_time_factor", &TwinServices::setRealTimeFactor, this)};
  ros::AdvertiseServiceOptions input;
  input.initBySpecType<ros::ServiceEvent<SetInput::Request, SetInput::Response>>(
      "set_input", [this](auto& call) { return setInput(call); });
  servers_.push_back(node.advertiseService(input));
  advertisePause(node);
}

void TwinServices::advertisePause(ros::NodeHandle node) {
  node.setCallbackQueue(&pause_queue_);
  servers_.push_back(node.advertiseService("pause", &TwinServices::pause, this));
  pause_thread_.start();
}

bool TwinServices::pause(Trigger::Request&, Trigger::Response& response) {
  return answered(commands_.pause(), response);
}

bool TwinServices::resume(Trigger::Request&, Trigger::Response& response) {
  return answered(commands_.resume(), response);
}

bool TwinServices::reset(Trigger::Request&, Trigger::Response& response) {
  return answered(commands_.reset(), response);
}

bool TwinServices::step(StepN::Request& request, StepN::Response& response) {
  const CommandResult result = commands_.step(request.steps);
  response.step = result.step;
  response.time = twin_.twin().seconds(result.step);
  return answered(result, response);
}

bool TwinServices::setSpeed(SetSpeed::Request& request, SetSpeed::Response& response) {
  const CommandResult result = commands_.setSpeed(
      request.drive, {request.speed, request.max_acceleration, request.max_jerk, 0.0});
  response.duration = result.duration;
  response.speed = result.speed;
  return answered(result, response);
}

bool TwinServices::setInput(ros::ServiceEvent<SetInput::Request, SetInput::Response>& call) {
  const SetInput::Request& request = call.getRequest();
  const CommandResult result =
      commands_.setInput(request.system, request.input, request.value, request.duration,
                         printable(call.getCallerName()));
  call.getResponse().step = result.step;
  return answered(result, call.getResponse());
}

bool TwinServices::setParameter(SetParameter::Request& request, SetParameter::Response& response) {
  ParameterRequest change{request.system, {request.parameter}, {request.value}, request.ramp};
  change.names.insert(change.names.end(), request.further_parameters.begin(),
                      request.further_parameters.end());
  change.values.insert(change.values.end(), request.further_values.begin(),
                       request.further_values.end());
  const CommandResult result = commands_.setParameter(change);
  response.previous = result.previous;
  response.step = result.step;
  return answered(result, response);
}

bool TwinServices::setRealTimeFactor(SetRealTimeFactor::Request& request,
                                     SetRealTimeFactor::Response& response) {
  return answered(commands_.setRealTimeFactor(request.factor), response);
}

void TwinServices::continueRamps() {
  for (const std::string& given_up : commands_.continueRamps()) {
    ROS_WARN("%s", given_up.c_str());
  }
}

}  // namespace whirl_twin
