// --channel: which channels of a log, or topics of a bag, a command is about.
#pragma once

#include <string>
#include <vector>

#include "tools/command.h"

namespace whirl_twin {

/// Patterns as the shell has them, *, ? and [...]; none means all.
using ChannelFilter = std::vector<std::string>;

void addChannelOption(const ProgramCommand& command, ChannelFilter& filter);

bool selects(const ChannelFilter& filter, const std::string& channel);

}  // namespace whirl_twin
