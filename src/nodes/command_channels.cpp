#include "nodes/command_channels.h"

#include <utility>

#include "messages/message_check.h"
#include "transport/command_channel.h"
#include "transport/lcm_connection.h"
#include "transport/payload_layout.h"

namespace whirl_twin {

namespace {

// As requireLayout() has them.
constexpr const char* kCommandLayout = "lslssnSDd";
constexpr const char* kAnswerLayout = "lslbslnSD";
constexpr int kMostMessagesAtOnce = 100;

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
  listen(commands_, [](const lcm_recv_buf_t* buffer, const char*, void* self) {
    auto* channels = static_cast<CommandChannels*>(self);
    channels->decode(buffer, kCommandLayout, channels->take_command_);
  });
}

void CommandChannels::take(std::function<void(const command_answer_t&)> handler) {
  take_answer_ = std::move(handler);
  listen(answers_, [](const lcm_recv_buf_t* buffer, const char*, void* self) {
    auto* channels = static_cast<CommandChannels*>(self);
    channels->decode(buffer, kAnswerLayout, channels->take_answer_);
  });
}

void CommandChannels::listen(const std::string& channel, lcm_msg_handler_t handler) {
  // LCM's C function says when it fails; the C++ one does not.
  if (lcm_subscribe(lcm_->getUnderlyingLCM(), channel.c_str(), handler, this) == nullptr) {
    throw LcmNotAvailable("LCM cannot receive " + channel + " (is multicast on?)");
  }
}

void CommandChannels::receive(std::chrono::milliseconds timeout) {
  handleArrived(*lcm_, timeout, kMostMessagesAtOnce);
}

template <class Type>
void CommandChannels::decode(const lcm_recv_buf_t* buffer, const char* layout,
                             const std::function<void(const Type&)>& handler) {
  // Called from C: nothing may be thrown through it.
  try {
    requireLayout(layout, buffer->data, buffer->data_size);
    Type message;
    if (message.decode(buffer->data, 0, static_cast<int>(buffer->data_size)) !=
        static_cast<int>(buffer->data_size)) {
      throw RejectedMessage(std::string("payload: not a ") + Type::getTypeName());
    }
    handler(message);
  } catch (const RejectedMessage& why) {
    ++malformed_;
    last_fault_ = why.what();
  }
}

}  // namespace whirl_twin
