// Opens LCM; a failure gives an actionable message.
#pragma once

#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "messages/input_error.h"

namespace whirl_twin {

// LCM channels of commands to the twin, twin_command_t, and of their answers, command_answer_t,
// without the prefix of the twin: nodes/command_channels.h sends and receives them. Their layouts
// are written as in requireLayout().

inline constexpr const char* kCommandsChannel = "COMMANDS";
inline constexpr const char* kAnswersChannel = "COMMAND_ANSWERS";
inline constexpr const char* kCommandLayout = "lslssnSDd";
inline constexpr const char* kAnswerLayout = "lslbslnSD";

/// LCM did not open; what() gives the url and the remedy.
class LcmNotAvailable : public RunFailure {
 public:
  using RunFailure::RunFailure;
};

/// An open LCM at `url`, e.g. kDefaultLcmUrl. Throws LcmNotAvailable.
std::shared_ptr<lcm::LCM> openLcm(const std::string& url);

/// Waits up to `timeout` for an event, then handles the queued events, at most `most` of them.
/// Returns their number.
int handleArrived(lcm::LCM& lcm, std::chrono::microseconds timeout, int most);

}  // namespace whirl_twin
