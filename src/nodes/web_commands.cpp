#include "nodes/web_commands.h"

#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/Acknowledge.h>
#include <whirl_twin/Inhibit.h>
#include <whirl_twin/SetInput.h>
#include <whirl_twin/SetParameter.h>
#include <whirl_twin/SetRealTimeFactor.h>
#include <whirl_twin/SetSpeed.h>
#include <whirl_twin/StepN.h>

#include <type_traits>
#include <utility>

#include "web/offered_services.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxWebTasks = 64;  // that wait

}  // namespace

TaskThread::TaskThread() : thread_([this] { run(); }) {}

TaskThread::~TaskThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  came_.notify_all();
  thread_.join();
}

bool TaskThread::put(std::function<void()> task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (tasks_.size() >= kMaxWebTasks) {
    return false;
  }
  tasks_.push_back(std::move(task));
  came_.notify_all();
  return true;
}

void TaskThread::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    came_.wait(lock, [this] { return ending_ || !tasks_.empty(); });
    if (ending_) {
      return;
    }
    const std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

WebCommands::WebCommands(WebServer& server, std::string simulation, std::string monitor)
    : server_(server), simulation_(std::move(simulation)), monitor_(std::move(monitor)) {}

template <class Service>
WebCommands::Answer WebCommands::callNode(const std::string& name, Service& exchange) {
  if (!ros::service::call(name, exchange)) {
    return {false, name + " does not answer: is its node running?"};
  }
  return {exchange.response.success != 0, exchange.response.message};
}

template <class Service>
WebCommands::Answer WebCommands::callTwin(const std::string& name, Service exchange) const {
  Answer answer = callNode(simulation_ + "/" + name, exchange);
  if constexpr (std::is_same_v<Service, StepN> || std::is_same_v<Service, SetInput>) {
    answer.step = exchange.response.step;
  }
  return answer;
}

template <class Service>
WebCommands::Answer WebCommands::callMonitor(const std::string& name, Service exchange) const {
  return callNode(monitor_ + "/" + name, exchange);
}

bool WebCommands::setParameters(ClientId client, std::vector<ParameterValue> values,
                                std::string id) {
  return commands_.put([this, client, values = std::move(values), id = std::move(id)] {
    ParameterRequest request;
    Answer answer{true, readParameters(values, request)};
    answer.done = answer.message.empty();
    if (answer.done && !values.empty()) {
      SetParameter exchange;
      exchange.request.system = request.system;
      exchange.request.parameter = request.names.front();
      exchange.request.value = request.values.front();
      exchange.request.further_parameters.assign(request.names.begin() + 1, request.names.end());
      exchange.request.further_values.assign(request.values.begin() + 1, request.values.end());
      answer = callTwin("set_parameter", exchange);
    }
    server_.post(
        [protocol = protocol_, client, values, id, why = answer.done ? "" : answer.message] {
          protocol->answerParameters(client, values, id, why);
        });
  });
}

bool WebCommands::callService(ClientId client, std::size_t service, std::uint32_t call,
                              Json request) {
  const std::string& name = offeredServices()[service].name;
  TaskThread& thread = name == "pause" || isOfMonitor(name) ? urgent_ : commands_;
  return thread.put([this, client, service, call, request = std::move(request)] {
    const Answer answer = carryOut(offeredServices()[service].name, request);
    const Json json = {
        {"success", answer.done}, {"message", answer.message}, {"step", answer.step}};
    server_.post([protocol = protocol_, client, service, call, json] {
      protocol->answerService(client, service, call, json, "");
    });
  });
}

WebCommands::Answer WebCommands::carryOut(const std::string& service, const Json& request) const {
  const auto number = [&](const char* field) { return request[field].get<double>(); };
  const auto text = [&](const char* field) { return request[field].get<std::string>(); };
  if (service == "step") {
    StepN exchange;
    const auto steps = request["steps"].get<std::uint64_t>();
    if (steps > UINT32_MAX) {
      return {false, "steps: must be at most " + std::to_string(UINT32_MAX)};
    }
    exchange.request.steps = static_cast<std::uint32_t>(steps);
    return callTwin(service, exchange);
  }
  if (service == "set_speed") {
    SetSpeed exchange;
    exchange.request.drive = text("drive");
    exchange.request.speed = number("speed");
    exchange.request.max_acceleration = number("max_acceleration");
    exchange.request.max_jerk = number("max_jerk");
    return callTwin(service, exchange);
  }
  if (service == "set_input") {
    SetInput exchange;
    exchange.request.system = text("system");
    exchange.request.input = text("input");
    exchange.request.value = number("value");
    exchange.request.duration = number("duration");
    return callTwin(service, exchange);
  }
  if (service == "set_real_time_factor") {
    SetRealTimeFactor exchange;
    exchange.request.factor = number("factor");
    return callTwin(service, exchange);
  }
  if (service == "acknowledge") {
    Acknowledge exchange;
    exchange.request.system = text("system");
    exchange.request.type = text("type");
    return callMonitor(service, exchange);
  }
  if (service == "inhibit") {
    Inhibit exchange;
    exchange.request.system = text("system");
    exchange.request.duration = number("duration");
    return callMonitor(service, exchange);
  }
  return service == "reset_alarms" ? callMonitor(service, std_srvs::Trigger())
                                   : callTwin(service, std_srvs::Trigger());
}

bool WebCommands::setInputs(ClientId client, state::InputCommand inputs) {
  return commands_.put([this, client, inputs = std::move(inputs)] {
    for (std::size_t i = 0; i < inputs.input.size(); ++i) {
      SetInput exchange;
      exchange.request.system = inputs.system;
      exchange.request.input = inputs.input[i];
      exchange.request.value = inputs.value[i];
      exchange.request.duration = inputs.duration;
      const Answer answer = callTwin("set_input", exchange);
      if (!answer.done) {
        server_.post([protocol = protocol_, client, why = answer.message] {
          protocol->complain(client, why);
        });
      }
    }
  });
}

}  // namespace whirl_twin
