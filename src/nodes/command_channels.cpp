#include "nodes/command_channels.h"

#include <utility>

#include "transport/lcm_connection.h"
#include "transport/payload_layout.h"

namespace whirl_twin {

namespace {

constexpr int kMaxMessagesAtOnce = 100;

}  // namespace

std::int64_t wallMicroseconds() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

CommandChannels::CommandChannels(const std::string& url, std::string prefix)
    : lcm_(openLcm(url)),
      commands_(prefix + kCommandsChannel),
      answers_(std::move(prefix) + kAnswersChannel) {}

void CommandChannels::send(twin_command_t command) {
  command.utime = wallMicroseconds();
  lcm_->publish(commands_, &command);
}

void CommandChannels::send(command_answer_t answer) {
  answer.utime = wallMicroseconds();
  lcm_->publish(answers_, &answer);
}

void CommandChannels::take(std::function<void(const twin_command_t&)> handler) {
  take_command_ = std::move(handler);
  listen(commands_, [](const lcm_recv_buf_t* buffer, const char* channel, void* self) {
    auto* channels = static_cast<CommandChannels*>(self);
    channels->pass(buffer, channel, kCommandLayout, channels->take_command_);
  });
}

void CommandChannels::take(std::function<void(const command_answer_t&)> handler) {
  take_answer_ = std::move(handler);
  listen(answers_, [](const lcm_recv_buf_t* buffer, const char* channel, void* self) {
    auto* channels = static_cast<CommandChannels*>(self);
    channels->pass(buffer, channel, kAnswerLayout, channels->take_answer_);
  });
}

void CommandChannels::listen(const std::string& channel, lcm_msg_handler_t handler) {
  // LCM's C function reports a failure; the C++ wrapper does not.
  if (lcm_subscribe(lcm_->getUnderlyingLCM(), channel.c_str(), handler, this) == nullptr) {
    throw LcmNotAvailable("LCM cannot receive " + channel + " (is multicast enabled?)");
  }
}

void CommandChannels::receive(std::chrono::milliseconds timeout) {
  handleArrived(*lcm_, timeout, kMaxMessagesAtOnce);
}

template <class Type>
void CommandChannels::pass(const lcm_recv_buf_t* buffer, const char* channel, const char* layout,
                           const std::function<void(const Type&)>& handler) {
  // Called from C: no exception may leave it.
  try {
    handler(decodePayload<Type>(layout, buffer->data, buffer->data_size));
  } catch (const RejectedMessage& why) {
    malformed_.add(channel, why.what());
  }
}

}  // namespace whirl_twin
