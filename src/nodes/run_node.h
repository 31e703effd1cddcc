// Common main function of the nodes: start, stop and exit status.
#pragma once

#include <functional>
#include <string>

namespace whirl_twin {

/// True after SIGINT or SIGTERM; threads poll it to stop.
bool stopRequested();

/// Prints `help` if the command line requests it. Else initialises ROS as node `name` with signals
/// that only set stopRequested(), waits for the ROS master, and runs `run`. Returns the exit
/// status: 0, or, after printing the message of an exception to standard error, 1 for a RunFailure
/// and 2 for an InputError or any other. (ROS's log is closed by then.)
int runNode(int argc, char** argv, const char* name, const std::string& help,
            const std::function<void()>& run);

}  // namespace whirl_twin
