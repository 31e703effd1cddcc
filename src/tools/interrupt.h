// Ctrl-C, for commands that end in order.
#pragma once

#include <atomic>

namespace whirl_twin {

/// From now on SIGINT and SIGTERM only ask for the end, by setting the flag that this returns.
std::atomic<bool>& catchInterrupts();

/// Whether they have.
bool interrupted();

}  // namespace whirl_twin
