// Where commands to the twin go on LCM, twin_command_t, and their answers, command_answer_t, behind
// the prefix of the twin: nodes/command_channels.h sends and takes them.
#pragma once

namespace whirl_twin {

inline constexpr const char* kCommandsChannel = "COMMANDS";
inline constexpr const char* kAnswersChannel = "COMMAND_ANSWERS";

}  // namespace whirl_twin
