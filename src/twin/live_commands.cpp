#include "twin/live_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include "messages/names.h"
#include "messages/wall_clock.h"

namespace whirl_twin {

namespace {

/// [s], longest duration of a command to an input.
constexpr double kMaxCommand = state::InputCommand::kLongest;

constexpr std::chrono::microseconds kAnswerPoll{500};

constexpr const char* kEnding = "the simulation is ending";

CommandResult notDone(std::string why) {
  CommandResult result;
  result.message = std::move(why);
  return result;
}

}  // namespace

std::string factorFault(double factor) {
  return Pace::canBe(factor) ? ""
                             : fmt::format(
                                   "real_time_factor: must be 0 (as fast as possible), or from "
                                   "{:g} to {:g}, found {}",
                                   Pace::kSlowest, Pace::kFastest, factor);
}

LiveCommands::LiveCommands(LiveTwin& twin, std::function<bool()> keep_waiting)
    : twin_(twin),
      keep_waiting_(std::move(keep_waiting)),
      parameters_(twin, [this] { return wait(); }) {}

bool LiveCommands::wait() {
  while (twin_.carriedOut() < twin_.sent()) {
    if (!keep_waiting_()) {
      return false;
    }
    std::this_thread::sleep_for(kAnswerPoll);
  }
  return true;
}

bool LiveCommands::carryOut(const TwinCommand& command, TwinAnswer& answer) {
  if (!twin_.send(command) || !wait()) {
    return false;
  }
  answer = twin_.answer();
  return true;
}

CommandResult LiveCommands::trigger(TwinCommand::Kind kind, const char* done) {
  TwinCommand command;
  command.kind = kind;
  TwinAnswer answer;
  CommandResult result;
  result.done = carryOut(command, answer);
  result.step = answer.step;
  result.message = result.done ? fmt::format("{} at step {}", done, answer.step) : kEnding;
  return result;
}

void LiveCommands::requestPause() noexcept {
  pauses_.fetch_add(1);
  twin_.pause();
}

CommandResult LiveCommands::pause() {
  requestPause();
  while (twin_.pausing() && keep_waiting_()) {
    std::this_thread::sleep_for(kAnswerPoll);
  }
  CommandResult result;
  result.done = !twin_.pausing();
  result.step = twin_.stepCount();
  result.message = result.done ? fmt::format("paused at step {}", result.step) : kEnding;
  return result;
}

CommandResult LiveCommands::resume() {
  return trigger(TwinCommand::Kind::kResume, "running");
}

CommandResult LiveCommands::reset() {
  CommandResult result =
      trigger(TwinCommand::Kind::kReset, "reset to the scene's start and parameters, now");
  if (result.done) {
    parameters_.restored();
  }
  return result;
}

/// Steps in parts that end at the updates of active ramps, so that each update is applied at its
/// step.
bool LiveCommands::stepPastUpdates(std::uint64_t steps, TwinAnswer& answer) {
  const std::uint64_t pauses = pauses_.load();
  TwinCommand command;
  command.kind = TwinCommand::Kind::kStep;
  do {
    command.steps = std::min(steps, parameters_.stepsToUpdate());
    if (!carryOut(command, answer)) {
      return false;
    }
    steps -= command.steps;
    for (std::string& given_up : parameters_.continueRamps()) {
      given_up_.push_back(std::move(given_up));
    }
    answer.done = answer.done && (steps == 0 || pauses_.load() == pauses);
  } while (answer.done && steps > 0);
  return true;
}

std::vector<std::string> LiveCommands::continueRamps() {
  std::vector<std::string> given_up = parameters_.continueRamps();
  given_up.insert(given_up.begin(), given_up_.begin(), given_up_.end());
  given_up_.clear();
  return given_up;
}

CommandResult LiveCommands::step(std::uint64_t steps) {
  TwinAnswer answer;
  const bool paused = twin_.paused();
  const bool carried_out = stepPastUpdates(steps, answer);
  CommandResult result;
  result.done = carried_out && answer.done;
  result.step = answer.step;
  result.message = !carried_out  ? kEnding
                   : answer.done ? fmt::format("{} steps done", steps)
                   : paused      ? fmt::format("interrupted by a pause at step {}", answer.step)
                                 : "not paused: call pause first";
  return result;
}

/// Returns why there is no such drive to move, or "".
std::string LiveCommands::findDrive(const std::string& name, std::size_t& drive) const {
  const auto& drives = twin_.twin().scene().drives;
  const auto found = std::find_if(drives.begin(), drives.end(),
                                  [&](const DriveSpec& one) { return one.name == name; });
  if (found == drives.end()) {
    std::vector<std::string> names;
    for (const DriveSpec& one : drives) {
      names.push_back(one.name);
    }
    const std::string near = nearestName(name, names);
    return fmt::format("drive: must be a drive of the scene, found {}{}", inQuotes(name),
                       near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
  }
  if (found->motor) {
    return fmt::format("drive: must not be a motor, whose speed is not prescribed, found {}", name);
  }
  drive = static_cast<std::size_t>(found - drives.begin());
  return "";
}

CommandResult LiveCommands::setSpeed(const std::string& drive, const SpeedMove& move) {
  TwinCommand command;
  command.kind = TwinCommand::Kind::kSetSpeed;
  if (std::string why = findDrive(drive, command.drive); !why.empty()) {
    return notDone(std::move(why));
  }
  SpeedMove moved{move.speed, move.max_acceleration, move.max_jerk, 0.0};
  if (const auto fault = faultOf(moved)) {
    return notDone(fmt::format("{}, found {}", fault->expected, fault->found));
  }
  const std::optional<SpeedReach> reach = parameters_.reachOf(command.drive, moved);
  if (!reach) {
    return notDone(kEnding);
  }
  moved.speed = reach->target;
  if (std::string why = parameters_.diagnosticOf(command.drive, *reach); !why.empty()) {
    return notDone(std::move(why));
  }
  command.speed = moved.speed;
  command.max_acceleration = moved.max_acceleration;
  command.max_jerk = moved.max_jerk;
  TwinAnswer answer;
  if (!parameters_.prepareFor(command.drive, moved) || !carryOut(command, answer)) {
    return notDone(kEnding);
  }
  CommandResult result;
  result.done = answer.done;
  result.step = answer.step;
  result.duration = answer.duration;
  result.speed = answer.done ? command.speed : std::numeric_limits<double>::quiet_NaN();
  result.message =
      answer.done ? fmt::format("{} reaches {:.6g} rad/s in {:.6g} s", drive, command.speed,
                                answer.duration)
                  : "the move is not possible: it would last too long or exceed the largest speed";
  if (answer.done && command.speed != move.speed) {
    result.message += fmt::format(": {} rad/s is in a barred speed range", move.speed);
  }
  return result;
}

std::string LiveCommands::readInput(const std::string& system_name, const std::string& input,
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

void LiveCommands::noteInput(const std::string& system, const std::string& input, double value,
                             double duration, const std::string& by) {
  const double step = twin_.twin().scene().stepSeconds();
  const std::int64_t since = twin_.stepCount();
  const std::int64_t until = since + static_cast<std::int64_t>(std::ceil(duration / step));
  held_inputs_[system + "/" + input] = {
      fmt::format("{}/{} is {} by {} since {} until t = {:g} s", system, input, value, by,
                  isoTime(wallClock()), static_cast<double>(until) * step),
      since, until};
}

std::string LiveCommands::heldInputs() const {
  const std::int64_t now = twin_.stepCount();
  std::string all;
  for (const auto& [name, held] : held_inputs_) {
    if (now >= held.since && now <= held.until) {  // else it is over, or the twin was reset
      all += (all.empty() ? "" : "; ") + held.text;
    }
  }
  return all;
}

std::string LiveCommands::take(const state::InputCommand& given, const std::string& by) {
  std::vector<TwinCommand> commands(given.input.size());
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const std::string why =
        readInput(given.system, given.input[i], given.value[i], given.duration, commands[i]);
    if (!why.empty()) {
      return why;
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

CommandResult LiveCommands::setInput(const std::string& system, const std::string& input,
                                     double value, double duration, const std::string& by) {
  TwinCommand command;
  TwinAnswer answer;
  if (std::string why = readInput(system, input, value, duration, command); !why.empty()) {
    return notDone(std::move(why));
  }
  if (!carryOut(command, answer)) {
    return notDone(kEnding);
  }
  if (answer.done) {
    noteInput(system, input, value, duration, by);
  }
  CommandResult result;
  result.done = answer.done;
  result.step = answer.step;
  result.message = answer.done
                       ? fmt::format("{}/{} is {} for {:g} s", system, input, value, duration)
                       : "the input cannot be set";
  return result;
}

CommandResult LiveCommands::setParameter(const ParameterRequest& request) {
  const ParameterAnswer answer = parameters_.set(request);
  CommandResult result;
  result.done = answer.done;
  result.message = answer.message;
  result.previous =
      answer.done ? answer.previous.front() : std::numeric_limits<double>::quiet_NaN();
  result.step = answer.step;
  return result;
}

CommandResult LiveCommands::setRealTimeFactor(double factor) {
  CommandResult result;
  result.message = factorFault(factor);
  result.done = result.message.empty();
  result.step = twin_.stepCount();
  if (result.done) {
    twin_.setPace(factor);
    result.message = factor == Pace::kAsFastAsItGoes
                         ? "as fast as it can be published"
                         : fmt::format("{:g} simulated seconds per second", factor);
  }
  return result;
}

}  // namespace whirl_twin
