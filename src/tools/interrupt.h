// Ctrl-C, for commands that end in order.
#pragma once

#include <atomic>

namespace whirl_twin {

/// From now on SIGINT and SIGTERM ask for the end, by setting the flag that this returns. Where
/// nothing asks interrupted() within 0.7 s, because a step of the work takes longer, or where a
/// second signal comes, the program ends there and then, with exit status 1: all files that are
/// finished before are whole (twin/durable_file.h).
std::atomic<bool>& catchInterrupts();

/// Whether they have. The caller ends in order then, and takes the time that it needs.
bool interrupted();

}  // namespace whirl_twin
