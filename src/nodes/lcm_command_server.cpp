#include "nodes/lcm_command_server.h"

#include <fmt/format.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "nodes/command_fields.h"

namespace whirl_twin {

std::string CommandArbiter::ask(const std::string& sender, double now) {
  const std::string other = holder(now);
  if (!other.empty() && other != sender) {
    return fmt::format("{} has the command for another {:.1f} s, longer if it sends more commands",
                       other, until_ - now);
  }
  holder_ = sender;
  until_ = now + duration_;
  return "";
}

void CommandArbiter::release(const std::string& sender) {
  if (sender == holder_) {
    until_ = -1.0;
  }
}

namespace {

constexpr std::size_t kMaxWaiting = 100;
constexpr std::int64_t kMaxWay = 5'000'000;  // [us], longest transit time of a valid command
constexpr const char* kRelease = "release";
constexpr const char* kTaker = "takes commands";  // heartbeat of a command server
constexpr double kMemory = 5.0;                   // [s], timeout of the heartbeats of others

double steadyNow() {
  return ros::SteadyTime::now().toSec();
}

std::vector<std::string> namesOfCommands() {
  std::vector<std::string> names{kRelease};
  eachCommand([&](const char* name, auto) { names.emplace_back(name); });
  return names;
}

/// Throws RejectedMessage for an invalid command.
template <class Service>
void call(const std::string& service, const twin_command_t& command, command_answer_t& answer) {
  Service exchange;
  ReadFields<twin_command_t> read(command);
  fieldsOf(read, exchange.request);
  read.finish();
  if (!ros::service::call(service, exchange)) {
    answer.message = service + " does not answer: is the simulation running?";
    return;
  }
  answer.done = exchange.response.success != 0 ? 1 : 0;
  answer.message = exchange.response.message;
  TellFields<command_answer_t> tell(answer);
  fieldsOf(tell, exchange.response);
}

}  // namespace

LcmCommandServer::LcmCommandServer(CommandChannels& channels, std::string name,
                                   std::string simulation, double lease, bool played)
    : channels_(channels),
      name_(std::move(name)),
      simulation_(std::move(simulation)),
      played_(played),
      lease_(lease) {
  channels_.take([this](const twin_command_t& command) { take(command); });
  channels_.take([this](const command_answer_t& answer) { hear(answer); });
  thread_ = std::thread([this] { run(); });
}

LcmCommandServer::~LcmCommandServer() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  came_.notify_all();
  thread_.join();
}

CommandCounts LcmCommandServer::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  CommandCounts counts = counts_;
  counts.holder = lease_.holder(steadyNow());
  return counts;
}

void LcmCommandServer::beat() {
  command_answer_t beat{};
  beat.sender = name_;
  beat.message = kTaker;
  channels_.send(beat);
}

void LcmCommandServer::hear(const command_answer_t& answer) {
  const std::int64_t way = wallMicroseconds() - answer.utime;
  if (answer.message == kTaker && answer.number == 0 && answer.sender != name_ &&
      std::abs(way) <= kMaxWay) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (heard_.size() < kMaxWaiting) {
      heard_[printable(answer.sender)] = steadyNow();
    }
  }
}

std::vector<std::string> LcmCommandServer::others() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> others;
  for (const auto& [name, at] : heard_) {
    if (steadyNow() - at <= kMemory) {
      others.push_back(name);
    }
  }
  return others;
}

void LcmCommandServer::take(const twin_command_t& command) {
  const std::string objection = diagnosticOf(command);
  if (!objection.empty()) {
    return refuse(command, objection);
  }
  if (command.command == "pause") {  // interrupts a step in progress
    return carryOut(command);
  }
  if (command.command == kRelease) {
    command_answer_t done{};
    done.done = 1;
    done.message = "command released";
    return answer(command, done);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.push_back(command);
  came_.notify_all();
}

/// Returns why the command is rejected, or ""; acquires or releases the lease.
std::string LcmCommandServer::diagnosticOf(const twin_command_t& command) {
  static const std::vector<std::string> kNames = namesOfCommands();
  if (command.sender.empty() || printable(command.sender) != command.sender) {
    return "sender: must be a name, found '" + printable(command.sender) + "'";
  }
  if (std::find(kNames.begin(), kNames.end(), command.command) == kNames.end()) {
    return "command: must be one of its commands, found '" + printable(command.command) + "'" +
           hint(command.command, kNames);
  }
  const std::int64_t way = wallMicroseconds() - command.utime;
  if (!played_ && (way > kMaxWay || way < -kMaxWay)) {
    return fmt::format(
        "utime: must be sent at most a few seconds ago, found {:.1f} s (a played log?); ~played "
        "accepts it",
        static_cast<double>(way) * 1.0e-6);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (command.command == "pause") {
    return "";
  }
  if (waiting_.size() >= kMaxWaiting) {
    return fmt::format("the queue is full: {} commands are waiting", waiting_.size());
  }
  const std::string before = lease_.holder(steadyNow());
  const std::string objection = lease_.ask(command.sender, steadyNow());
  if (objection.empty() && before.empty()) {
    ROS_INFO("%s has the command", command.sender.c_str());
  }
  if (command.command == kRelease) {
    lease_.release(command.sender);
  }
  return objection;
}

void LcmCommandServer::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    came_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) {
      return;
    }
    const twin_command_t command = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    carryOut(command);
    lock.lock();
  }
}

void LcmCommandServer::carryOut(const twin_command_t& command) {
  command_answer_t result{};
  try {
    eachCommand([&](const char* name, auto kind) {
      if (command.command == name) {
        call<typename decltype(kind)::Service>(simulation_ + "/" + name, command, result);
      }
    });
  } catch (const RejectedMessage& why) {
    return refuse(command, why.what());
  }
  answer(command, result);
}

void LcmCommandServer::refuse(const twin_command_t& command, const std::string& why) {
  const std::string text =
      printable(command.command) + " of " + printable(command.sender) + " is refused: " + why;
  ROS_WARN_THROTTLE(1.0, "%s", text.c_str());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++counts_.refused;
    counts_.last_refusal = text;
  }
  command_answer_t refused{};
  refused.message = why;
  refused.sender = command.sender;
  refused.number = command.number;
  channels_.send(refused);
}

void LcmCommandServer::answer(const twin_command_t& command, command_answer_t answer) {
  answer.sender = command.sender;
  answer.number = command.number;
  channels_.send(answer);
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.taken;
  counts_.latency.add(1000 * (wallMicroseconds() - command.utime));
}

}  // namespace whirl_twin
