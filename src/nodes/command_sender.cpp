#include "nodes/command_sender.h"

#include <chrono>
#include <utility>

#include "nodes/command_fields.h"

namespace whirl_twin {

CommandSender::CommandSender(CommandChannels& channels, ros::NodeHandle node, std::string name,
                             double timeout)
    : channels_(channels), name_(std::move(name)), timeout_(timeout) {
  channels_.take([this](const command_answer_t& answer) { take(answer); });
  eachCommand([&](const char* command, auto kind) {
    advertise<typename decltype(kind)::Service>(node, command);
  });
}

template <class Service>
void CommandSender::advertise(ros::NodeHandle& node, const std::string& command) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  const boost::function<bool(Request&, Response&)> serve = [this, command](Request& request,
                                                                           Response& response) {
    twin_command_t message{};
    message.command = command;
    TellFields<twin_command_t> tell(message);
    fieldsOf(tell, request);
    const std::optional<command_answer_t> answer = exchange(message);
    response.success = answer && answer->done != 0;
    response.message =
        answer ? answer->message
               : fmt::format("no answer within {:g} s: no receiver, or it takes longer", timeout_);
    if (answer) {
      ReadFields<command_answer_t> read(*answer);
      fieldsOf(read, response);
    }
    return true;
  };
  servers_.push_back(node.advertiseService(command, serve));
}

std::optional<command_answer_t> CommandSender::exchange(twin_command_t command) {
  std::unique_lock<std::mutex> lock(mutex_);
  const std::int64_t number = ++number_;
  awaited_[number] = std::nullopt;
  command.sender = name_;
  command.number = number;
  const auto sent = std::chrono::steady_clock::now();
  channels_.send(command);
  came_.wait_for(lock, std::chrono::duration<double>(timeout_),
                 [&] { return awaited_[number].has_value(); });
  const std::optional<command_answer_t> answer = std::move(awaited_[number]);
  awaited_.erase(number);
  if (answer) {
    latency_.add(std::chrono::nanoseconds(std::chrono::steady_clock::now() - sent).count());
  } else {
    ++unanswered_;
  }
  return answer;
}

void CommandSender::take(const command_answer_t& answer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto awaited = awaited_.find(answer.number);
  if (answer.sender == name_ && awaited != awaited_.end()) {
    awaited->second = answer;
    came_.notify_all();
  }
}

std::uint64_t CommandSender::sent() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<std::uint64_t>(number_);
}

std::uint64_t CommandSender::unanswered() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return unanswered_;
}

TimingHistogram CommandSender::latency() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return latency_;
}

}  // namespace whirl_twin
