// The commands of `twin`, one file each. Every function adds its command to the command line; when
// the command is given, parsing runs it. A command that cannot do its work throws one of the
// exceptions below (or SceneError), which main() turns into messages and an exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace whirl_twin {

/// Exit statuses of `twin`.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;    ///< the run failed: diverged, a file cannot be written
inline constexpr int kBadInput = 2;  ///< a scene, a file or an option is wrong

/// Input or usage is wrong: exit status 2. One message a line.
class BadInput : public std::runtime_error {
 public:
  explicit BadInput(const std::string& message) : std::runtime_error(message) {}
};

/// The run itself failed: exit status 1.
class RunFailed : public std::runtime_error {
 public:
  explicit RunFailed(const std::string& message) : std::runtime_error(message) {}
};

// `status` outlives the command line; it is what the program exits with if nothing is thrown.
void addCheckCommand(CLI::App& twin, int& status);
void addScenesCommand(CLI::App& twin, int& status);
void addModelsCommand(CLI::App& twin, int& status);
void addSimulateCommand(CLI::App& twin, int& status);
void addPlotCommand(CLI::App& twin, int& status);
void addAnalyzeCommand(CLI::App& twin, int& status);
void addCampbellCommand(CLI::App& twin, int& status);
void addResponseCommand(CLI::App& twin, int& status);
void addOrbitCommand(CLI::App& twin, int& status);
void addTradeoffCommand(CLI::App& twin, int& status);
void addBalanceCommand(CLI::App& twin, int& status);
void addRouthCommand(CLI::App& twin, int& status);
void addLogCommand(CLI::App& twin, int& status);

}  // namespace whirl_twin
