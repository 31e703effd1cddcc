// Where commands to the twin go on LCM, twin_command_t, and their answers, command_answer_t, behind
// the prefix of the twin: nodes/command_channels.h sends and takes them. Their layouts are written
// as requireLayout() has them.
#pragma once

namespace whirl_twin {

inline constexpr const char* kCommandsChannel = "COMMANDS";
inline constexpr const char* kAnswersChannel = "COMMAND_ANSWERS";
inline constexpr const char* kCommandLayout = "lslssnSDd";
inline constexpr const char* kAnswerLayout = "lslbslnSD";

}  // namespace whirl_twin
