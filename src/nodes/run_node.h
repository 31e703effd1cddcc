// What the mains of the simulation and the monitor have in common: how they end.
#pragma once

#include <functional>
#include <string>

namespace whirl_twin {

/// True once SIGINT or SIGTERM has come; threads end by looking at it.
bool stopRequested();

/// Prints `help` if it is asked for. Else initialises ROS as node `name` with signals
/// that only set stopRequested(), waits for the ROS master, and runs `run`. Returns the exit
/// status: 0, or after printing to standard error what an exception says 1 for a RunFailure and 2
/// for a Refusal or any other. (ROS's own log is closed by then.)
int runNode(int argc, char** argv, const char* name, const std::string& help,
            const std::function<void()>& run);

}  // namespace whirl_twin
