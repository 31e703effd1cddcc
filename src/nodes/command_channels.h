// Sends and decodes commands to a twin and their answers on LCM.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "transport/refused_payloads.h"
#include "whirl_twin/command_answer_t.hpp"
#include "whirl_twin/twin_command_t.hpp"

namespace whirl_twin {

/// [us], wall clock.
std::int64_t wallMicroseconds();

class CommandChannels {
 public:
  /// Throws LcmNotAvailable.
  CommandChannels(const std::string& url, std::string prefix);

  // Any thread; the functions set utime.
  void send(twin_command_t command);
  void send(command_answer_t answer);

  // One thread only.

  /// handler is called from receive(), and must not throw. Throws LcmNotAvailable.
  void take(std::function<void(const twin_command_t&)> handler);
  void take(std::function<void(const command_answer_t&)> handler);
  void receive(std::chrono::milliseconds timeout);
  /// Malformed payloads.
  const RefusedPayloads& malformed() const { return malformed_; }

 private:
  void listen(const std::string& channel, lcm_msg_handler_t handler);
  template <class Type>
  void pass(const lcm_recv_buf_t* buffer, const char* channel, const char* layout,
            const std::function<void(const Type&)>& handler);

  std::shared_ptr<lcm::LCM> lcm_;
  std::string commands_, answers_;  // channels
  std::function<void(const twin_command_t&)> take_command_;
  std::function<void(const command_answer_t&)> take_answer_;
  RefusedPayloads malformed_;
};

}  // namespace whirl_twin
