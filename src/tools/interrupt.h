// Handling of Ctrl-C for commands with an orderly end.
#pragma once

#include <atomic>

namespace whirl_twin {

/// Installs handlers: SIGINT and SIGTERM request termination by setting the returned flag. If
/// interrupted() is not called within 0.7 s, because a work step takes longer, or on a second
/// signal, the program exits at once with status 1: all files finished before are complete
/// (twin/durable_file.h).
std::atomic<bool>& catchInterrupts();

/// Was an end requested? The caller then ends in an orderly way, without a time limit.
bool interrupted();

}  // namespace whirl_twin
