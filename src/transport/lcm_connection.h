// Opening LCM, with a sentence a person can act on when it does not open.
#pragma once

#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "messages/refusal.h"

namespace whirl_twin {

// Where commands to the twin go on LCM, twin_command_t, and their answers, command_answer_t, behind
// the prefix of the twin: nodes/command_channels.h sends and takes them. Their layouts are written
// as requireLayout() has them.

inline constexpr const char* kCommandsChannel = "COMMANDS";
inline constexpr const char* kAnswersChannel = "COMMAND_ANSWERS";
inline constexpr const char* kCommandLayout = "lslssnSDd";
inline constexpr const char* kAnswerLayout = "lslbslnSD";

/// LCM did not open; what() says at which url and what to do about it.
class LcmNotAvailable : public RunFailure {
 public:
  using RunFailure::RunFailure;
};

/// An open LCM at `url`, e.g. kDefaultLcmUrl. Throws LcmNotAvailable.
std::shared_ptr<lcm::LCM> openLcm(const std::string& url);

/// Waits up to `timeout` for an event, then has all that have arrived handled, at most `most` of
/// them. Returns how many.
int handleArrived(lcm::LCM& lcm, std::chrono::microseconds timeout, int most);

}  // namespace whirl_twin
