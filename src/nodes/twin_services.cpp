#include "nodes/twin_services.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "messages/names.h"
#include "messages/wall_clock.h"
#include "scene/node_reader.h"

namespace whirl_twin {

namespace {

/// [s], longest duration of a command to an input.
constexpr double kMaxCommand = state::InputCommand::kLongest;

constexpr std::chrono::microseconds kAnswerPoll{500};

constexpr const char* kEnded = "the simulation is ending";

}  // namespace

std::string factorFault(double factor) {
  return Pace::canBe(factor) ? ""
                             : fmt::format(
                                   "real_time_factor: must be 0 (as fast as possible), or from "
                                   "{:g} to {:g}, found {}",
                                   Pace::kSlowest, Pace::kFastest, factor);
}

TwinServices::TwinServices(LiveTwin& twin, ros::NodeHandle node, std::function<bool()> keep_waiting)
    : twin_(twin),
      keep_waiting_(std::move(keep_waiting)),
      parameters_(twin, [this] { return wait(); }) {
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

bool TwinServices::wait() {
  while (twin_.carriedOut() < twin_.sent()) {
    if (!keep_waiting_()) {
      return false;
    }
    std::this_thread::sleep_for(kAnswerPoll);
  }
  return true;
}

bool TwinServices::carryOut(const TwinCommand& command, TwinAnswer& answer) {
  if (!twin_.send(command) || !wait()) {
    return false;
  }
  answer = twin_.answer();
  return true;
}

bool TwinServices::trigger(TwinCommand::Kind kind, const char* done, Trigger::Response& response) {
  TwinCommand command;
  command.kind = kind;
  TwinAnswer answer;
  response.success = carryOut(command, answer);
  response.message = response.success ? fmt::format("{} at step {}", done, answer.step) : kEnded;
  return true;
}

bool TwinServices::pause(Trigger::Request&, Trigger::Response& response) {
  pauses_.fetch_add(1);
  twin_.pause();
  while (twin_.pausing() && keep_waiting_()) {
    std::this_thread::sleep_for(kAnswerPoll);
  }
  response.success = !twin_.pausing();
  response.message =
      response.success ? fmt::format("paused at step {}", twin_.stepCount()) : kEnded;
  return true;
}

bool TwinServices::resume(Trigger::Request&, Trigger::Response& response) {
  return trigger(TwinCommand::Kind::kResume, "running", response);
}

bool TwinServices::reset(Trigger::Request&, Trigger::Response& response) {
  trigger(TwinCommand::Kind::kReset, "reset to the scene's start and parameters, now", response);
  if (response.success) {
    parameters_.restored();
  }
  return true;
}

/// Steps in parts that end at the updates of active ramps, so that each update is applied at its
/// step.
bool TwinServices::stepPastUpdates(std::uint64_t steps, TwinAnswer& answer) {
  const std::uint64_t pauses = pauses_.load();
  TwinCommand command;
  command.kind = TwinCommand::Kind::kStep;
  do {
    command.steps = std::min(steps, parameters_.stepsToUpdate());
    if (!carryOut(command, answer)) {
      return false;
    }
    steps -= command.steps;
    continueRamps();
    answer.done = answer.done && (steps == 0 || pauses_.load() == pauses);
  } while (answer.done && steps > 0);
  return true;
}

bool TwinServices::step(StepN::Request& request, StepN::Response& response) {
  TwinAnswer answer;
  const bool paused = twin_.paused();
  const bool carried_out = stepPastUpdates(request.steps, answer);
  response.success = carried_out && answer.done;
  response.step = answer.step;
  response.time = twin_.twin().seconds(answer.step);
  response.message = !carried_out  ? kEnded
                     : answer.done ? fmt::format("{} steps done", request.steps)
                     : paused      ? fmt::format("interrupted by a pause at step {}", answer.step)
                                   : "not paused: call pause first";
  return true;
}

bool TwinServices::setSpeed(SetSpeed::Request& request, SetSpeed::Response& response) {
  const auto& drives = twin_.twin().scene().drives;
  const auto found = std::find_if(drives.begin(), drives.end(), [&](const DriveSpec& drive) {
    return drive.name == request.drive;
  });
  response.success = false;
  if (found == drives.end()) {
    std::vector<std::string> names;
    for (const DriveSpec& drive : drives) {
      names.push_back(drive.name);
    }
    const std::string near = nearestName(request.drive, names);
    response.message = fmt::format("drive: must be a drive of the scene, found {}{}",
                                   whirl_twin::inQuotes(request.drive),
                                   near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
    return true;
  }
  if (found->motor) {
    response.message = fmt::format(
        "drive: must not be a motor, whose speed is not prescribed, found {}", request.drive);
    return true;
  }
  if (const auto fault =
          faultOf({request.speed, request.max_acceleration, request.max_jerk, 0.0})) {
    response.message = fmt::format("{}, found {}", fault->expected, fault->found);
    return true;
  }
  TwinCommand command;
  command.kind = TwinCommand::Kind::kSetSpeed;
  command.drive = static_cast<std::size_t>(found - drives.begin());
  command.speed = request.speed;
  command.max_acceleration = request.max_acceleration;
  command.max_jerk = request.max_jerk;
  TwinAnswer answer;
  SpeedMove move{request.speed, request.max_acceleration, request.max_jerk, 0.0};
  const std::optional<SpeedReach> reach = parameters_.reachOf(command.drive, move);
  if (!reach) {
    response.message = kEnded;
    return true;
  }
  move.speed = command.speed = reach->target;
  response.message = parameters_.diagnosticOf(command.drive, *reach);
  if (!response.message.empty()) {
    return true;
  }
  if (!parameters_.prepareFor(command.drive, move) || !carryOut(command, answer)) {
    response.message = kEnded;
    return true;
  }
  response.success = answer.done;
  response.duration = answer.duration;
  response.speed = answer.done ? command.speed : std::nan("");
  response.message =
      answer.done ? fmt::format("{} reaches {:.6g} rad/s in {:.6g} s", request.drive, command.speed,
                                answer.duration)
                  : "the move is not possible: it would last too long or exceed the largest speed";
  if (answer.done && command.speed != request.speed) {
    response.message += fmt::format(": {} rad/s is in a barred speed range", request.speed);
  }
  return true;
}

std::string TwinServices::readInput(const std::string& system_name, const std::string& input,
                                    double value, double duration, TwinCommand& command) const {
  std::vector<std::string> systems;
  for (const SharedSystem& system : twin_.twin().systems()) {
    systems.push_back(system->spec.name);
  }
  const auto system = std::find(systems.begin(), systems.end(), system_name);
  if (system == systems.end()) {
    return fmt::format("system: must be a system of the scene, found {}{}", inQuotes(system_name),
                       hint(system_name, systems));
  }
  command.kind = TwinCommand::Kind::kSetInput;
  command.system = static_cast<std::size_t>(system - systems.begin());
  const BuiltSystem& built = *twin_.twin().systems()[command.system];
  std::vector<std::string> commanded;
  const std::vector<InputInfo> inputs = built.dynamics->inputs();
  bool found = false;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto given = built.spec.inputs.find(inputs[i].name);
    if (given != built.spec.inputs.end() && given->second.kind == InputSignal::Kind::kHeld) {
      commanded.push_back(inputs[i].name);
      if (inputs[i].name == input) {
        command.input = i;
        found = true;
      }
    }
  }
  if (!found) {
    return fmt::format("input: must be an input given as a number in the scene, found {}{}",
                       inQuotes(input),
                       commanded.empty() ? "; there are none" : hint(input, commanded));
  }
  if (!std::isfinite(value)) {
    return fmt::format("value: must be a finite number, found {}", value);
  }
  if (!(duration > 0.0 && duration <= kMaxCommand)) {
    return fmt::format("duration: must be > 0 s and at most {:g} s, found {}", kMaxCommand,
                       duration);
  }
  command.value = value;
  command.duration = std::max<std::int64_t>(1, std::llround(duration * 1e9));
  return "";
}

void TwinServices::noteInput(const std::string& system, const std::string& input, double value,
                             double duration, const std::string& by) {
  const double step = twin_.twin().scene().stepSeconds();
  const std::int64_t since = twin_.stepCount();
  const std::int64_t until = since + static_cast<std::int64_t>(std::ceil(duration / step));
  held_inputs_[system + "/" + input] = {
      fmt::format("{}/{} is {} by {} since {} until t = {:g} s", system, input, value, by,
                  isoTime(wallClock()), static_cast<double>(until) * step),
      since, until};
}

std::string TwinServices::heldInputs() const {
  const std::int64_t now = twin_.stepCount();
  std::string all;
  for (const auto& [name, held] : held_inputs_) {
    if (now >= held.since && now <= held.until) {  // else it is over, or the twin was reset
      all += (all.empty() ? "" : "; ") + held.text;
    }
  }
  return all;
}

std::string TwinServices::take(const state::InputCommand& given, const std::string& by) {
  std::vector<TwinCommand> commands(given.input.size());
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const std::string refused =
        readInput(given.system, given.input[i], given.value[i], given.duration, commands[i]);
    if (!refused.empty()) {
      return refused;
    }
  }
  for (const TwinCommand& command : commands) {
    if (!twin_.send(command)) {
      return "the command queue of the loop is full";
    }
  }
  for (std::size_t i = 0; i < commands.size(); ++i) {
    noteInput(given.system, given.input[i], given.value[i], given.duration, by);
  }
  return "";
}

bool TwinServices::setInput(ros::ServiceEvent<SetInput::Request, SetInput::Response>& call) {
  const SetInput::Request& request = call.getRequest();
  SetInput::Response& response = call.getResponse();
  TwinCommand command;
  TwinAnswer answer;
  response.success = false;
  response.message =
      readInput(request.system, request.input, request.value, request.duration, command);
  if (!response.message.empty()) {
    return true;
  }
  if (!carryOut(command, answer)) {
    response.message = kEnded;
    return true;
  }
  if (answer.done) {
    noteInput(request.system, request.input, request.value, request.duration,
              printable(call.getCallerName()));
  }
  response.success = answer.done;
  response.step = answer.step;
  response.message = answer.done ? fmt::format("{}/{} is {} for {:g} s", request.system,
                                               request.input, request.value, request.duration)
                                 : "the input cannot be set";
  return true;
}

bool TwinServices::setParameter(SetParameter::Request& request, SetParameter::Response& response) {
  ParameterRequest change{request.system, {request.parameter}, {request.value}, request.ramp};
  change.names.insert(change.names.end(), request.further_parameters.begin(),
                      request.further_parameters.end());
  change.values.insert(change.values.end(), request.further_values.begin(),
                       request.further_values.end());
  const ParameterAnswer answer = parameters_.set(change);
  response.success = answer.done;
  response.message = answer.message;
  response.previous = answer.done ? answer.previous.front() : std::nan("");
  response.step = answer.step;
  return true;
}

bool TwinServices::setRealTimeFactor(SetRealTimeFactor::Request& request,
                                     SetRealTimeFactor::Response& response) {
  response.message = factorFault(request.factor);
  response.success = response.message.empty();
  if (response.success) {
    twin_.setPace(request.factor);
    response.message = request.factor == Pace::kAsFastAsItGoes
                           ? "as fast as it can be published"
                           : fmt::format("{:g} simulated seconds per second", request.factor);
  }
  return true;
}

void TwinServices::continueRamps() {
  for (const std::string& given_up : parameters_.continueRamps()) {
    ROS_WARN("%s", given_up.c_str());
  }
}

}  // namespace whirl_twin
