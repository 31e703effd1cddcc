#include "web/served_twin.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "messages/commands.h"
#include "messages/input_error.h"
#include "monitoring/alarm_commands.h"
#include "web/offered_services.h"
#include "web/scene_description.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kMinStep = 10'000;          // ns, of the fixed-rate loop
constexpr std::chrono::milliseconds kTaskPoll{2};  // of the queue
constexpr std::size_t kMaxTasks = 64;              // that wait
constexpr const char* kBrowser = "a client of the web server";

/// Buffer for half a second of delay of the publisher, at least 64 records.
std::size_t ringCapacityOf(const Scene& scene) {
  if (scene.step < kMinStep) {
    throw InputError(fmt::format("{}: step: must be >= {:g} s to run live, found {:g} s",
                                 scene.source, static_cast<double>(kMinStep) * 1.0e-9,
                                 scene.stepSeconds()));
  }
  return static_cast<std::size_t>(std::clamp<std::int64_t>(500'000'000 / scene.step, 64, 100'000));
}

FixedRateLoop::Options optionsOf(const Scene& scene, RealtimeMode mode) {
  FixedRateLoop::Options options;
  options.period = scene.step;
  options.mode = mode;
  return options;
}

std::int64_t stepsBetween(const Scene& scene, double rate) {
  return rate == 0.0 ? 1
                     : std::max<std::int64_t>(1, std::llround(1.0 / (rate * scene.stepSeconds())));
}

Json answerJson(bool done, const std::string& message) {
  return {{"success", done}, {"message", message}};
}

}  // namespace

ServedTwin::ServedTwin(const Scene& scene, const ServeSettings& settings,
                       std::function<bool()> go_on)
    : go_on_(std::move(go_on)),
      live_(scene, ringCapacityOf(scene)),
      loop_(optionsOf(scene, settings.realtime)),
      commands_(live_, [this] { return go_on_() && loop_.running(); }),
      server_(settings.access, settings.limits, settings.files),
      protocol_(server_, *this, "whirl_twin " + scene.name, settings.read_only, offeredServices()),
      publisher_(live_, loop_, server_, protocol_, settings.alarms,
                 stepsBetween(scene, settings.rate), settings.read_only) {
  if (std::string why = factorFault(settings.real_time_factor); !why.empty()) {
    throw InputError(why);
  }
  live_.setPace(settings.real_time_factor);
  if (settings.paused) {
    live_.restore(true);
  }
}

ServedTwin::~ServedTwin() {
  stop();
}

bool ServedTwin::run() {
  loop_.start([this](std::int64_t scheduled) { return live_.cycle(scheduled); });
  publisher_.start();
  server_.start(protocol_);
  while (go_on_() && loop_.running()) {
    runTasks();
    commands_.continueRamps();
    std::this_thread::sleep_for(kTaskPoll);
  }
  const bool ended_by_caller = loop_.running();
  stop();
  return ended_by_caller;
}

void ServedTwin::stop() {
  loop_.stop();
  publisher_.join();
  server_.stop();
}

bool ServedTwin::enqueue(Task task) {
  const std::lock_guard<std::mutex> lock(tasks_mutex_);
  if (tasks_.size() >= kMaxTasks) {
    return false;
  }
  tasks_.push_back(std::move(task));
  return true;
}

void ServedTwin::runTasks() {
  while (go_on_()) {
    Task task;
    {
      const std::lock_guard<std::mutex> lock(tasks_mutex_);
      if (tasks_.empty()) {
        return;
      }
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task();
  }
}

bool ServedTwin::setParameters(ClientId client, std::vector<ParameterValue> values,
                               std::string id) {
  return enqueue([this, client, values = std::move(values), id = std::move(id)] {
    carryOut(client, values, id);
  });
}

void ServedTwin::carryOut(ClientId client, const std::vector<ParameterValue>& values,
                          const std::string& id) {
  ParameterRequest request;
  std::string why = readParameters(values, request);
  if (why.empty() && !values.empty()) {
    const CommandResult result = commands_.setParameter(request);
    why = result.done ? "" : result.message;
  }
  server_.post(
      [this, client, values, id, why] { protocol_.answerParameters(client, values, id, why); });
}

bool ServedTwin::callService(ClientId client, std::size_t service, std::uint32_t call,
                             Json request) {
  const std::string& name = offeredServices()[service].name;
  if (isOfMonitor(name)) {
    return alarmCommand(client, service, call, request);
  }
  if (name == "pause") {
    commands_.requestPause();  // now: it interrupts a step in progress
  }
  return enqueue([this, client, service, call, request = std::move(request)] {
    carryOut(client, service, call, request);
  });
}

bool ServedTwin::setInputs(ClientId client, state::InputCommand inputs) {
  return enqueue([this, client, inputs = std::move(inputs)] {
    if (const std::string why = commands_.take(inputs, kBrowser); !why.empty()) {
      server_.post([this, client, why] { protocol_.complain(client, why); });
    }
  });
}

void ServedTwin::carryOut(ClientId client, std::size_t service, std::uint32_t call,
                          const Json& request) {
  const CommandResult result = commandOf(offeredServices()[service].name, request);
  Json answer = answerJson(result.done, result.message);
  answer["step"] = result.step;
  server_.post([this, client, service, call, answer = std::move(answer)] {
    protocol_.answerService(client, service, call, answer, "");
  });
}

CommandResult ServedTwin::commandOf(const std::string& service, const Json& request) {
  const auto number = [&](const char* field) { return request[field].get<double>(); };
  const auto text = [&](const char* field) { return request[field].get<std::string>(); };
  if (service == "pause") {
    return commands_.pause();
  }
  if (service == "resume") {
    return commands_.resume();
  }
  if (service == "reset") {
    return commands_.reset();
  }
  if (service == "step") {
    return commands_.step(request["steps"].get<std::uint64_t>());
  }
  if (service == "set_speed") {
    return commands_.setSpeed(
        text("drive"), {number("speed"), number("max_acceleration"), number("max_jerk"), 0.0});
  }
  if (service == "set_input") {
    return commands_.setInput(text("system"), text("input"), number("value"), number("duration"),
                              kBrowser);
  }
  return commands_.setRealTimeFactor(number("factor"));
}

bool ServedTwin::alarmCommand(ClientId client, std::size_t service, std::uint32_t call,
                              const Json& request) {
  const std::string& name = offeredServices()[service].name;
  state::AlarmCommand command;
  command.command = name == "acknowledge"    ? state::AlarmCommand::kAcknowledge
                    : name == "reset_alarms" ? state::AlarmCommand::kReset
                                             : state::AlarmCommand::kInhibit;
  for (const auto& [field, type] : offeredServices()[service].fields) {  // their types are checked
    if (field == "system") {
      command.system = request[field].get<std::string>();
    } else if (field == "type") {
      command.type = request[field].get<std::string>();
    } else {
      command.duration = request[field].get<double>();
    }
  }
  return publisher_.post([this, client, service, call, command](TwinMonitor& monitor, double now) {
    const CommandAnswer answer = whirl_twin::carryOut(command, monitor, now, kBrowser);
    server_.post([this, client, service, call, answer] {
      protocol_.answerService(client, service, call, answerJson(answer.done, answer.text), "");
    });
  });
}

}  // namespace whirl_twin
